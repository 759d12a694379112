#include "lsp/Places.h"

#include "support/Printable.h"

#include <algorithm>
#include <filesystem>

namespace dotek::lsp {
namespace {

// Bytes of the character that begins with this one; 1 for what begins none.
std::size_t lengthOf(unsigned char first) {
  return first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
}

// How many bytes of a line are before a column.
std::size_t bytesBefore(std::string_view utf8, std::uint64_t column, Units units) {
  std::size_t at = 0;
  std::uint64_t passed = 0;
  while (at < utf8.size() && passed < column) {
    const std::size_t length = std::min(lengthOf(static_cast<unsigned char>(utf8[at])), utf8.size() - at);
    passed += units == Units::Utf8 ? length : length == 4 ? 2 : 1;
    if (passed > column && units == Units::Utf8) break; // within a character
    at += length;
  }
  return at;
}

struct LinePlace {
  std::uint64_t line = 0, column = 0;
};
std::optional<LinePlace> lineColumnOf(const Json& position) {
  if (!position.is_object()) return std::nullopt;
  const auto line = position.find("line"), column = position.find("character");
  if (line == position.end() || column == position.end() || !line->is_number_integer() ||
      !column->is_number_integer())
    return std::nullopt;
  const auto whole = [](const Json& number) {
    if (number.is_number_unsigned()) return number.get<std::uint64_t>();
    return static_cast<std::uint64_t>(std::max<std::int64_t>(0, number.get<std::int64_t>()));
  };
  return LinePlace{whole(*line), whole(*column)};
}

int digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

} // namespace

std::uint32_t columnsOf(std::string_view utf8, Units units) {
  if (units == Units::Utf8) return static_cast<std::uint32_t>(utf8.size());
  std::uint32_t out = 0;
  for (std::size_t at = 0; at < utf8.size();) {
    const std::size_t length = lengthOf(static_cast<unsigned char>(utf8[at]));
    out += length == 4 ? 2 : 1;
    at += length;
  }
  return out;
}

Json positionOf(const SourceFile& file, std::uint32_t offset, Units units) {
  const auto size = static_cast<std::uint32_t>(file.bytes().size());
  offset = std::min(offset, size);
  const std::uint32_t line = file.lineOf(offset);
  const std::uint32_t start = file.lineStart(line);
  const std::string_view bytes = file.line(line);
  const std::string before =
      toUtf8(bytes.substr(0, std::min<std::size_t>(offset - start, bytes.size())), file.encoding());
  return {{"line", line - 1}, {"character", columnsOf(before, units)}};
}

Json rangeOf(const SourceFile& file, SourceRange range, Units units) {
  return {{"start", positionOf(file, range.begin, units)}, {"end", positionOf(file, range.end, units)}};
}

std::optional<std::uint32_t> offsetOf(const SourceFile& file, const Json& position, Units units) {
  const std::optional<LinePlace> place = lineColumnOf(position);
  if (!place) return std::nullopt;
  if (place->line >= file.lineCount()) return static_cast<std::uint32_t>(file.bytes().size());
  const auto line = static_cast<std::uint32_t>(place->line) + 1;
  const std::string_view bytes = file.line(line);
  if (file.encoding() == Encoding::Utf8)
    return file.lineStart(line) + static_cast<std::uint32_t>(bytesBefore(bytes, place->column, units));
  // One byte a character: as many bytes as characters are before the column.
  const std::string text = toUtf8(bytes, file.encoding());
  const std::string_view before = std::string_view(text).substr(0, bytesBefore(text, place->column, units));
  const auto characters = static_cast<std::uint32_t>(
      std::count_if(before.begin(), before.end(), [](char c) { return (c & 0xC0) != 0x80; }));
  return file.lineStart(line) + characters;
}

std::optional<std::uint32_t> offsetOf(std::string_view text, const Json& position, Units units) {
  const std::optional<LinePlace> place = lineColumnOf(position);
  if (!place) return std::nullopt;
  std::size_t begin = 0;
  for (std::uint64_t line = 0; line < place->line; ++line) {
    const std::size_t end = text.find_first_of("\r\n", begin);
    if (end == std::string_view::npos) return static_cast<std::uint32_t>(text.size());
    begin = end + (text[end] == '\r' && end + 1 < text.size() && text[end + 1] == '\n' ? 2 : 1);
  }
  const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
  return static_cast<std::uint32_t>(begin +
                                    bytesBefore(text.substr(begin, end - begin), place->column, units));
}

std::optional<std::string> pathOf(std::string_view uri) {
  constexpr std::string_view kScheme = "file://";
  if (!uri.starts_with(kScheme)) return std::nullopt;
  uri.remove_prefix(kScheme.size());
  if (uri.starts_with("localhost/")) uri.remove_prefix(9);
  if (!uri.starts_with('/')) return std::nullopt; // a file of another machine
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      path += uri[i];
      continue;
    }
    const int high = i + 1 < uri.size() ? digitOf(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? digitOf(uri[i + 2]) : -1;
    if (high < 0 || low < 0 || (high == 0 && low == 0)) return std::nullopt;
    path += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return std::filesystem::path(path).lexically_normal().generic_string();
}

std::string uriOf(std::string_view path) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string out = "file://";
  for (const char c : path) {
    if (kPlain.find(c) != std::string_view::npos) {
      out += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    out += '%';
    out += kHex[byte >> 4];
    out += kHex[byte & 15];
  }
  return out;
}

} // namespace dotek::lsp
