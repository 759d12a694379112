#include "support/Source.h"

#include "support/Characters.h"

#include <algorithm>

namespace dotek {

SourceRange spanning(SourceRange a, SourceRange b) {
  if (!a.hasPlace()) return b;
  if (!b.hasPlace()) return a;
  return {a.file, std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

SourceFile::SourceFile(std::string name, std::string bytes, Encoding encoding, std::uint32_t firstLine)
    : name_(std::move(name)), bytes_(std::move(bytes)), encoding_(encoding), firstLine_(firstLine) {
  if (bytes_.starts_with("\xEF\xBB\xBF")) bytes_.erase(0, 3);
  lineStarts_.push_back(0);
  for (std::size_t i = 0; i < bytes_.size(); ++i) {
    if (bytes_[i] != '\n' && bytes_[i] != '\r') continue;
    const bool crlf = bytes_[i] == '\r' && i + 1 < bytes_.size() && bytes_[i + 1] == '\n';
    if (!crlf) lineStarts_.push_back(static_cast<std::uint32_t>(i + 1));
  }
}

std::uint32_t SourceFile::lineOf(std::uint32_t offset) const {
  const auto next = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset);
  return static_cast<std::uint32_t>(next - lineStarts_.begin()) + firstLine_ - 1;
}

std::uint32_t SourceFile::lineStart(std::uint32_t line) const {
  return lineStarts_.at(line - firstLine_);
}

std::string_view SourceFile::line(std::uint32_t line) const {
  const std::uint32_t begin = lineStart(line);
  const std::size_t next = line - firstLine_ + 1;
  const std::size_t end = next < lineStarts_.size() ? lineStarts_[next] : bytes_.size();
  std::string_view text = std::string_view(bytes_).substr(begin, end - begin);
  while (text.ends_with('\n') || text.ends_with('\r'))
    text.remove_suffix(1);
  return text;
}

LineColumn SourceFile::place(std::uint32_t offset) const {
  const std::uint32_t at = std::min(offset, static_cast<std::uint32_t>(bytes_.size()));
  const std::uint32_t line = lineOf(at);
  const std::uint32_t begin = lineStart(line);
  const std::string_view before = std::string_view(bytes_).substr(begin, at - begin);
  return {line, static_cast<std::uint32_t>(charactersOf(before, encoding_) + 1)};
}

FileId SourceMap::add(SourceFile file) {
  files_.push_back(std::move(file));
  return size() - 1;
}

std::string_view SourceMap::text(SourceRange range) const {
  if (!range.hasPlace()) return {};
  return std::string_view(file(range.file).bytes()).substr(range.begin, range.end - range.begin);
}

std::string SourceMap::textUtf8(SourceRange range) const {
  if (!range.hasPlace()) return {};
  return toUtf8(text(range), file(range.file).encoding());
}

std::uint32_t SourceMap::line(SourceRange range) const {
  return range.hasPlace() ? file(range.file).lineOf(range.begin) : 0;
}

} // namespace dotek
