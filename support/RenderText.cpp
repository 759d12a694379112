#include "support/Diagnostics.h"
#include "support/Printable.h"

#include <algorithm>

namespace dotek {
namespace {

constexpr std::size_t kShownColumns = 160;

std::size_t characters(std::string_view utf8) {
  return static_cast<std::size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// Byte offset of the character with index `count`.
std::size_t byteOf(std::string_view utf8, std::size_t count) {
  std::size_t at = 0;
  while (at < utf8.size() && count > 0) {
    ++at;
    while (at < utf8.size() && (utf8[at] & 0xC0) == 0x80)
      ++at;
    --count;
  }
  return at;
}

void appendPlace(std::string& out, SourceRange range, const SourceMap& sources) {
  if (!range.hasPlace()) {
    out += "dotek: ";
    return;
  }
  const LineColumn at = sources.file(range.file).place(range.begin);
  out += fmt::format("{}:{}:{}: ", printable(sources.file(range.file).name()), at.line, at.column);
}

// The line and the caret below it; a long line is cut around the caret.
void appendExcerpt(std::string& out, SourceRange range, const SourceMap& sources) {
  if (!range.hasPlace()) return;
  const SourceFile& file = sources.file(range.file);
  const LineColumn begin = file.place(range.begin);
  std::string text = printable(file.lineUtf8(begin.line));
  if (text.empty()) return; // nothing to point at
  const std::size_t length = characters(text);
  std::size_t column = begin.column - 1;
  std::size_t width = 1;
  if (range.end > range.begin) {
    const LineColumn end = file.place(range.end);
    width = end.line == begin.line ? end.column - begin.column : (length > column ? length - column : 1);
  }
  width = std::max<std::size_t>(width, 1);
  const std::size_t from =
      column > kShownColumns / 2 && length > kShownColumns ? column - kShownColumns / 2 : 0;
  const bool cutEnd = length > from + kShownColumns;
  const std::size_t first = byteOf(text, from);
  text = text.substr(first, byteOf(std::string_view(text).substr(first), kShownColumns));
  column -= from;
  if (from > 0) {
    text.insert(0, "...");
    column += 3;
  }
  width =
      std::min(width, std::max<std::size_t>(characters(text) > column ? characters(text) - column : 1, 1));
  if (cutEnd) text += "...";
  out += "  " + text + "\n  " + std::string(column, ' ') + "^" + std::string(width - 1, '~') + "\n";
}

} // namespace

std::string renderText(const Diagnostics& diagnostics, const SourceMap& sources, std::uint32_t maxErrors) {
  std::string out;
  std::uint32_t errors = 0;
  std::uint32_t left = 0;
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity == Severity::Error && ++errors > maxErrors && maxErrors != 0) {
      ++left;
      continue;
    }
    appendPlace(out, d.range, sources);
    out += fmt::format("{}: {} [{}]\n", severityName(d.severity), printable(d.message), d.code);
    appendExcerpt(out, d.range, sources);
    for (const DiagnosticNote& note : d.notes) {
      appendPlace(out, note.range, sources);
      out += fmt::format("note: {}\n", printable(note.message));
      appendExcerpt(out, note.range, sources);
    }
    if (d.fix) {
      appendPlace(out, d.fix->edits.empty() ? d.range : d.fix->edits.front().range, sources);
      out += fmt::format("fix: {}\n", printable(d.fix->title));
    }
  }
  if (left > 0)
    out += fmt::format("dotek: note: {} more errors are not shown; --max-errors 0 shows all\n", left);
  return out;
}

} // namespace dotek
