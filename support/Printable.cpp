#include "support/Printable.h"

#include "support/Decimal.h"
#include "support/Source.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek {
namespace {

struct Letter {
  char32_t code = 0;
  std::size_t length = 1; // in bytes
  bool isUtf8 = true;
};

Letter letterAt(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
  if (byte(0) < 0x80) return {byte(0), 1, true};
  const std::size_t length = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (at + length > text.size() || !isUtf8(text.substr(at, length))) return {byte(0), 1, false};
  char32_t code = byte(0) & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i)
    code = code << 6 | (byte(i) & 0x3Fu);
  return {code, length, true};
}

// Control characters, C1, and what turns the direction of the letters that follow.
bool steers(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || c == 0x061C || c == 0x200E || c == 0x200F ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

bool isPlain(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7F; });
}

// Each letter as `show` has it.
template <class Show> std::string mapped(std::string_view text, const Show& show) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Letter letter = letterAt(text, at);
    show(out, letter, text.substr(at, letter.length));
    at += letter.length;
  }
  return out;
}

} // namespace

std::string printable(std::string_view bytes) {
  if (isPlain(bytes)) return std::string(bytes);
  return mapped(bytes, [](std::string& out, const Letter& letter, std::string_view text) {
    if (letter.code == '\t')
      out += ' ';
    else if (!letter.isUtf8 || steers(letter.code))
      out += '?';
    else
      out += text;
  });
}

std::string printableLines(std::string_view bytes) {
  const auto plain = [](char c) { return (c >= 0x20 && c < 0x7F) || c == '\n' || c == '\t'; };
  if (std::all_of(bytes.begin(), bytes.end(), plain)) return std::string(bytes);
  std::string out;
  out.reserve(bytes.size());
  while (!bytes.empty()) {
    const std::size_t end = bytes.find_first_of("\n\t");
    std::string_view line = bytes.substr(0, end);
    const bool both = end != std::string_view::npos && bytes[end] == '\n' && line.ends_with('\r');
    if (both) line.remove_suffix(1);
    out += printable(line);
    if (both) out += '\r';
    if (end == std::string_view::npos) break;
    out += bytes[end];
    bytes.remove_prefix(end + 1);
  }
  return out;
}

std::string asUtf8(std::string_view bytes) {
  if (isUtf8(bytes)) return std::string(bytes);
  return mapped(bytes, [](std::string& out, const Letter& letter, std::string_view text) {
    if (letter.isUtf8)
      out += text;
    else
      out += fmt::format("\\x{:02X}", static_cast<unsigned>(letter.code));
  });
}

std::string jsonString(std::string_view bytes) {
  std::string out = "\"";
  for (const char c : asUtf8(bytes)) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (c == '\n')
      out += "\\n";
    else if (c == '\r')
      out += "\\r";
    else if (c == '\t')
      out += "\\t";
    else if (c >= 0 && c < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return escapeMarks(out + "\"");
}

std::string jsonNumber(double value, int places) {
  return std::isfinite(value) ? fixedText(value, places) : "null";
}

std::string escapeMarks(std::string_view json) {
  // Most of it is ASCII, which has been escaped already but for DEL.
  const auto rare = [](char c) { return c < 0 || c == 0x7F; };
  if (std::none_of(json.begin(), json.end(), rare)) return std::string(json);
  return mapped(json, [](std::string& out, const Letter& letter, std::string_view text) {
    if (letter.isUtf8 && letter.code >= 0x7F && steers(letter.code))
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(letter.code));
    else
      out += text;
  });
}

} // namespace dotek
