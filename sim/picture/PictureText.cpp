#include "sim/picture/PictureText.h"

#include "support/Decimal.h"
#include "support/Printable.h"

#include <cstdint>
#include <fmt/format.h>

namespace dotek::sim {
namespace {

// The bytes of the character that begins at `at`; 0: they are no UTF-8.
std::size_t characterLength(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
  };
  const std::uint8_t first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  }
  const std::uint8_t second = byte(at + 1);
  // Longer than needed, halves of pairs, beyond the last character.
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
    return 0;
  return length;
}

template <class Escape> std::string escaped(std::string_view text, std::size_t most, const Escape& escape) {
  std::string out;
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); ++count) {
    if (count == most) return out + "\xE2\x80\xA6";
    const std::size_t length = characterLength(text, at);
    if (length == 0) {
      out += "\xEF\xBF\xBD";
      ++at;
      continue;
    }
    escape(text.substr(at, length), out);
    at += length;
  }
  return out;
}

// What turns the order of letters or steers a terminal is `?`, as in messages: a page is read beside its
// source.
std::string shown(std::string_view character) {
  return character.size() == 1 ? std::string(character) : printable(character);
}

} // namespace

std::string xmlText(std::string_view text, std::size_t most) {
  return escaped(text, most, [](std::string_view character, std::string& out) {
    switch (character[0]) {
    case '&': out += "&amp;"; return;
    case '<': out += "&lt;"; return;
    case '>': out += "&gt;"; return;
    case '"': out += "&quot;"; return;
    case '\'': out += "&#39;"; return;
    default: break;
    }
    const bool unknown = static_cast<std::uint8_t>(character[0]) < 0x20 || character == "\x7F" ||
                         character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
    out += unknown ? " " : shown(character);
  });
}

std::string jsonText(std::string_view text, std::size_t most) {
  const auto escape = [](std::string_view character, std::string& out) {
    const bool isMarkup =
        character == "<" || character == ">" || character == "&"; // they could close the script
    const bool isLineEnd =
        character == "\xE2\x80\xA8" || character == "\xE2\x80\xA9"; // of scripts, not of JSON
    if (character == "\"" || character == "\\")
      out += fmt::format("\\{}", character);
    else if (isMarkup)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(character[0]));
    else if (static_cast<std::uint8_t>(character[0]) < 0x20 || character == "\x7F" || isLineEnd)
      out += ' ';
    else
      out += shown(character);
  };
  return '"' + escaped(text, most, escape) + '"';
}

std::string shortNumber(double value, int places) {
  std::string out = fixedText(value, places);
  if (places == 0) return out;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.ends_with('.')) out.pop_back();
  return out == "-0" ? "0" : out;
}

} // namespace dotek::sim
