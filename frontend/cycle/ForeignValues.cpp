// Values and coordinates as drawings, other languages and G code write them.
#include "frontend/cycle/Foreign.h"
#include "support/Ascii.h"
#include "support/Decimal.h"

#include <CycleLexer.h>

#include <fmt/format.h>

namespace dotek::frontend::cycle {

using Lexer = grammar::CycleLexer;

namespace {

bool isMove(const Line& line) {
  return line.type(0) == Lexer::KW_MOVE || line.type(1) == Lexer::KW_MOVE;
}

// `5 [mm]`, `5 (mm)`.
std::string bracketed(const Line& line) {
  const size_t at = line.at();
  if (at == 0 || line.type(at - 1) != Lexer::NUMBER || line.type(at + 1) != Lexer::UNIT) return "";
  if (line.word(at) != "[" && line.word(at) != "(") return "";
  return fmt::format("a unit follows its number without brackets; write `{} {}`", line.word(at - 1),
                     line.word(at + 1));
}

// `50 %`.
std::string percent(const Line& line) {
  const size_t at = line.at();
  if (at == 0 || line.word(at) != "%" || line.type(at - 1) != Lexer::NUMBER) return "";
  const std::optional<double> number = parseNumber(line.word(at - 1));
  return number ? fmt::format("a share is a number without `%`; write `{}`", numberText(*number / 100)) : "";
}

// `tolerance = +/- 0.1 mm`.
std::string bothWays(const Line& line) {
  const size_t at = line.at();
  const bool plusMinus = at > 0 && line.type(at) == Lexer::SLASH && line.type(at - 1) == Lexer::PLUS &&
                         line.type(at + 1) == Lexer::MINUS;
  if (!plusMinus) return "";
  const size_t end = at + 2;
  if (line.type(end) != Lexer::NUMBER)
    return "a tolerance has no `+/-`; it is compared as `abs(error) > tolerance`";
  return fmt::format("a tolerance has no `+/-`; write `{}`, and compare it as `abs(error) > tolerance`",
                     line.text(end, line.type(end + 1) == Lexer::UNIT ? end + 2 : end + 1));
}

// "200" of `F200`, "-5" of `Z-5.`.
std::string numberOf(const std::string& code) {
  std::string out = code.substr(1);
  if (out.starts_with('+')) out.erase(0, 1);
  if (out.ends_with('.')) out.pop_back();
  return out;
}

// `move to X10 Y20`, `feed move by z -2 mm F200`, `.. F 200`.
std::string words(const Line& line) {
  const size_t at = line.at();
  if (!isMove(line) || at >= line.size()) return "";
  std::string out = line.text(0, at), parts, feed;
  for (size_t i = at; i < line.size(); ++i) {
    const std::string word = line.word(i);
    const size_t type = line.type(i);
    const bool apart = type == Lexer::ODD_NAME && word.size() == 1 && line.type(i + 1) == Lexer::NUMBER;
    if (type != Lexer::CODE && !apart) return "";
    const std::string number = apart ? line.word(++i) : numberOf(word);
    if (number.empty()) return "";
    if (word[0] == 'F') {
      feed = number;
      continue;
    }
    if (std::string_view("XYZABC").find(word[0]) == std::string_view::npos) return "";
    const bool unit = line.type(i + 1) == Lexer::UNIT;
    const std::string_view by =
        std::string_view("XYZ").find(word[0]) == std::string_view::npos ? "deg" : "mm";
    parts += fmt::format("{}{} {} {}", parts.empty() ? "" : ", ", lowerCase(word.substr(0, 1)), number,
                         unit ? line.word(i + 1) : by);
    if (unit) ++i;
    if (line.type(i + 1) == Lexer::COMMA) ++i;
  }
  const bool reach = line.type(at - 1) == Lexer::KW_TO || line.type(at - 1) == Lexer::KW_BY;
  if (!parts.empty()) out += (reach ? " " : line.type(at - 1) == Lexer::KW_MOVE ? " to " : ", ") + parts;
  if (!feed.empty()) out += fmt::format(" feed {} mm/min", feed);
  return fmt::format("`{}` is G code; write `{}`", line.word(at), out);
}

// `alarm "Error is " + hole.error`.
std::string joined(const Line& line) {
  const size_t at = line.at(), type = line.type(0);
  const bool says = type == Lexer::KW_ALARM || type == Lexer::KW_STOP || type == Lexer::KW_REPORT;
  const bool joins = line.type(at) == Lexer::PLUS || line.type(at) == Lexer::COMMA || line.word(at) == "&";
  if (!says || !joins || at == 0 || line.type(at - 1) != Lexer::TEXT || at + 1 >= line.size()) return "";
  const std::string value = line.type(at + 1) == Lexer::TEXT ? "size" : line.rest(at + 1);
  return fmt::format("a text holds no value; `report {} measured {}` in a line before it prints one",
                     line.word(at - 1), value);
}

} // namespace

std::string foreignValue(const Line& line) {
  for (const auto& form : {bracketed, percent, bothWays, words, joined})
    if (std::string message = form(line); !message.empty()) return message;
  return "";
}

} // namespace dotek::frontend::cycle
