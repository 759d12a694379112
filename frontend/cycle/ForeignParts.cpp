// Lines whose beginning is right: parts in another order, a title without quotes, half a comparison.
#include "frontend/cycle/Foreign.h"
#include "frontend/cycle/Words.h"
#include "support/Ascii.h"

#include <CycleLexer.h>

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::frontend::cycle {

using Lexer = grammar::CycleLexer;

namespace {

template <size_t N> bool isOneOf(size_t type, const std::array<size_t, N>& types) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

bool isClause(size_t type) {
  return isOneOf<5>(
      type, {Lexer::KW_REQUIRE, Lexer::KW_RANGE, Lexer::KW_GROUP, Lexer::KW_LETTER, Lexer::KW_PICTURE});
}

bool isText(size_t type) {
  return type == Lexer::TEXT || type == Lexer::OPEN_TEXT;
}

bool declaresValue(const Line& line) {
  return line.type(0) == Lexer::KW_PARAMETER || line.type(0) == Lexer::KW_RESULT;
}

// " text", or nothing for nothing.
std::string after(const std::string& text) {
  return text.empty() ? "" : " " + text;
}

std::string first(const Line& line, size_t end) {
  return line.text(0, end);
}

// ---- declarations ----------------------------------------------------------------------------------------

size_t clauseFrom(const Line& line, size_t from) {
  while (from < line.size() && !isClause(line.type(from)))
    ++from;
  return from;
}

// `parameter down : length = 8 mm From the start down`, `cycle bore Bore with four touches`.
std::string untitled(const Line& line) {
  const bool begins = line.type(0) == Lexer::KW_CYCLE || line.type(0) == Lexer::KW_OPTIONS;
  const size_t at = line.at();
  if ((!begins && !declaresValue(line)) || at >= line.size()) return "";
  if (at < (begins ? 2 : line.find(Lexer::COLON) + 2)) return "";
  const std::string word = line.word(at);
  const size_t type = line.type(at);
  if (!(isLetter(word[0]) || word[0] == '_') || isClause(type) || type == Lexer::KW_OPTIONAL) return "";
  const bool chooses = !begins && line.type(line.find(Lexer::COLON) + 1) == Lexer::KW_CHOICE;
  if (chooses && line.find(Lexer::EQUALS) > at && isName(word)) {
    if (line.type(at - 1) == Lexer::KW_CHOICE)
      return fmt::format("a choice is one of its names; write `{} of {}`", first(line, at), line.rest(at));
    const bool joined = type == Lexer::KW_OR || type == Lexer::KW_AND;
    return fmt::format("a comma is between the names of a choice; write `{}, {}`", first(line, at),
                       line.rest(joined ? at + 1 : at));
  }
  const size_t end = clauseFrom(line, at);
  for (size_t i = 0; i < end; ++i)
    if (isText(line.type(i)) || (i >= at && (line.type(i) == Lexer::EQUALS || line.type(i) == Lexer::ARROW)))
      return "";
  // The unit of a number.
  if (line.type(at - 1) == Lexer::NUMBER && (end == at + 1 || isForeignUnit(word))) return "";
  std::string title = line.text(at, end);
  std::replace(title.begin(), title.end(), '_', ' ');
  const size_t cut = std::min(at, clauseFrom(line, 0));
  return fmt::format("a title is in `\"`; write `{} \"{}\"{}{}`", first(line, cut), title,
                     after(line.text(cut, at)), after(line.rest(end)));
}

// `range 1 mm, 50 mm`, `range 1 mm - 50 mm`, `range 1..50 mm`.
std::string ranged(const Line& line) {
  if (!declaresValue(line)) return "";
  size_t range = line.size();
  for (size_t i = 0; i < line.size() && i <= line.at(); ++i) {
    if (isClause(line.type(i))) range = line.type(i) == Lexer::KW_RANGE ? i : line.size();
    if (range < i && line.type(i) == Lexer::KW_TO) return "";
  }
  if (range == line.size() || line.at() <= range) return "";
  const std::string_view why = "`range` takes the least value and the largest, with `to` between them";
  // `range from 1 mm to 5 mm`.
  if (line.at() == range + 2 && line.type(range + 1) == Lexer::NAME)
    return fmt::format("{}; write `range {}`", why, line.text(range + 2, clauseFrom(line, range + 1)));
  const auto joins = [&](size_t i) {
    return isOneOf<5>(line.type(i), {Lexer::COMMA, Lexer::MINUS, Lexer::COLON, Lexer::DOT, Lexer::KW_AND}) ||
           (line.type(i) == Lexer::NAME && line.type(i + 1) == Lexer::NUMBER);
  };
  const size_t end = std::min(clauseFrom(line, range + 1), line.find(Lexer::TEXT, range));
  size_t middle = std::min(line.at(), end);
  // What was read up to there may hold the sign between the two.
  for (size_t i = range + 2; i < middle; ++i)
    if (joins(i)) middle = i;
  size_t second = std::min(middle + (joins(middle) ? 1 : 0), end);
  while (second < end && joins(second) && line.type(second) != Lexer::MINUS)
    ++second;
  std::string least = line.text(range + 1, middle), largest = line.text(second, end);
  const bool dots = least.ends_with('.') && largest.starts_with('.');
  if (dots) {
    least.pop_back();
    largest.erase(0, 1);
  }
  const bool bare = middle == range + 2 && line.type(range + 1) == Lexer::NUMBER;
  if (bare && end > 0 && line.type(end - 1) == Lexer::UNIT) least += " " + line.word(end - 1);
  if (least.empty() || largest.empty()) return fmt::format("{}; write `range 1 mm to 50 mm`", why);
  return fmt::format("{}; write `range {} to {}`", why, least, largest);
}

// The parts of a declaration in another order than the language's.
std::string ordered(const Line& line) {
  if (!declaresValue(line)) return "";
  const size_t colon = line.find(Lexer::COLON);
  if (line.at() < colon + 2 || line.at() >= line.size()) return "";
  const auto begins = [&](size_t i) {
    const size_t type = line.type(i);
    return i >= line.size() || isClause(type) || isText(type) || type == Lexer::EQUALS ||
           type == Lexer::KW_OPTIONAL;
  };
  if (!begins(line.at())) return "";
  const auto part = [&](size_t from) {
    while (!begins(from))
      ++from;
    return from;
  };
  const size_t kind = part(colon + 1);
  std::string value, title, clauses;
  bool optional = false;
  for (size_t i = kind; i < line.size();) {
    const size_t type = line.type(i);
    size_t end = part(i + 1);
    if (type == Lexer::KW_OPTIONAL) {
      optional = true;
      end = i + 1;
    } else if (type == Lexer::EQUALS) {
      value = line.text(i, end);
    } else if (isText(type)) {
      if (!title.empty()) return "";
      title = line.word(i);
      end = i + 1;
    } else {
      const bool says = type == Lexer::KW_REQUIRE || type == Lexer::KW_GROUP || type == Lexer::KW_PICTURE;
      if (says && end < line.size() && isText(line.type(end))) ++end;
      clauses += after(line.text(i, end));
    }
    i = end;
  }
  const std::string head = first(line, kind);
  if (line.type(0) == Lexer::KW_RESULT) {
    if (value.empty() && !optional) return "";
    return fmt::format("a result gets its value where the cycle computes it, `{} = ..`; write `{}{}`",
                       line.word(1), head, after(title));
  }
  if (optional && !value.empty())
    return fmt::format("what has a default always has a value; write `{} optional{}{}`, or leave out "
                       "`optional`: `{} {}{}{}`",
                       head, after(title), clauses, head, value, after(title), clauses);
  const std::string right =
      fmt::format("{}{}{}{}{}", head, optional ? " optional" : "", after(value), after(title), clauses);
  return fmt::format("after the kind come `optional` or the default, the title, and then the checks; write "
                     "`{}`",
                     right);
}

// `parameter end : length`, `touch x by 5 mm -> end`.
std::string named(const Line& line) {
  if (line.at() == 0 || line.at() >= line.size()) return "";
  const std::string word = line.word(line.at());
  const size_t before = line.type(line.at() - 1);
  const bool names = isOneOf<7>(before, {Lexer::KW_PARAMETER, Lexer::KW_RESULT, Lexer::KW_CYCLE,
                                         Lexer::KW_OPTIONS, Lexer::KW_FOR, Lexer::KW_USE, Lexer::ARROW});
  if (!names || !isReserved(word)) return "";
  return fmt::format("`{0}` is a word of the language, so nothing can be called that; write `{1}`", word,
                     proposeName(word));
}

// ---- lines -----------------------------------------------------------------------------------------------

bool beginsStatement(size_t type) {
  return isOneOf<21>(type, {Lexer::KW_CYCLE, Lexer::KW_PARAMETER, Lexer::KW_RESULT, Lexer::KW_NEEDS,
                            Lexer::KW_PROBE, Lexer::KW_SPINDLE,   Lexer::KW_RAPID,  Lexer::KW_PROTECTED,
                            Lexer::KW_MOVE,  Lexer::KW_TOUCH,     Lexer::KW_SET,    Lexer::KW_IF,
                            Lexer::KW_END,   Lexer::KW_REPEAT,    Lexer::KW_FOR,    Lexer::KW_WHILE,
                            Lexer::KW_CALL,  Lexer::KW_ALARM,     Lexer::KW_STOP,   Lexer::KW_REPORT,
                            Lexer::KW_DWELL});
}

// A statement may end there.
bool endsStatement(size_t type) {
  return isOneOf<16>(type,
                     {Lexer::NAME, Lexer::NUMBER, Lexer::UNIT, Lexer::TEXT, Lexer::RPAREN, Lexer::KW_ON,
                      Lexer::KW_OFF, Lexer::KW_FLOOD, Lexer::KW_MIST, Lexer::KW_START, Lexer::KW_OPTIONAL,
                      Lexer::TYPE, Lexer::KW_LENGTH, Lexer::WORK_OFFSET, Lexer::KW_TIMES, Lexer::KW_PROBE});
}

// `spindle off probe on`, `probe off; spindle off`, `a = 1 mm b = 2 mm`.
std::string several(const Line& line) {
  const size_t at = line.at();
  if (at == 0 || at >= line.size() || !endsStatement(line.type(at - 1))) return "";
  const bool semicolon = line.word(at) == ";";
  const size_t next = semicolon ? at + 1 : at;
  if (semicolon && next == line.size()) return "a statement ends with its line; take out the `;`";
  const bool assigns = line.type(next) == Lexer::NAME && line.type(next + 1) == Lexer::EQUALS;
  if (!assigns && !beginsStatement(line.type(next))) return "";
  if (assigns && !semicolon && line.type(0) == Lexer::KW_CALL)
    return fmt::format("a comma is between what a call hands over; write `{}, {}`", first(line, at),
                       line.rest(at));
  const bool asks =
      line.type(0) == Lexer::KW_IF || (line.type(0) == Lexer::KW_ELSE && line.type(1) == Lexer::KW_IF);
  if (asks && line.find(Lexer::KW_THEN) == line.size())
    return fmt::format("a condition ends with `then`, and what is to happen is in the lines after it; write "
                       "`{} then`",
                       first(line, at));
  return fmt::format("a line holds one statement; write `{}` in the next one", line.rest(next));
}

// ---- conditions ------------------------------------------------------------------------------------------

bool compares(size_t type) {
  return isOneOf<7>(type, {Lexer::LESS, Lexer::LESS_EQUAL, Lexer::GREATER, Lexer::GREATER_EQUAL,
                           Lexer::FOREIGN_EQUAL, Lexer::KW_IS, Lexer::EQUALS});
}

bool isJoin(size_t type) {
  return type == Lexer::KW_AND || type == Lexer::KW_OR;
}

// Where the comparison begins that `at` is in.
size_t comparisonBegin(const Line& line, size_t at) {
  constexpr std::array<size_t, 7> kBefore = {Lexer::KW_IF,  Lexer::KW_WHILE, Lexer::KW_REQUIRE, Lexer::KW_NOT,
                                             Lexer::KW_AND, Lexer::KW_OR,    Lexer::LPAREN};
  while (at > 0 && !isOneOf(line.type(at - 1), kBefore))
    --at;
  return at;
}

size_t comparisonIn(const Line& line, size_t from, size_t end) {
  while (from < end && !compares(line.type(from)))
    ++from;
  return from;
}

// `if 0 mm < a < 5 mm then`, `if a > 1 mm and < 5 mm then`.
std::string compared(const Line& line) {
  const size_t at = line.at();
  if (at < 2 || at >= line.size() || !compares(line.type(at))) return "";
  if (line.type(at - 1) == Lexer::KW_REQUIRE && line.type(0) == Lexer::KW_PARAMETER)
    return fmt::format("a comparison has two sides; write `{} {} {}`", first(line, at), line.word(1),
                       line.rest(at));
  const bool half = isJoin(line.type(at - 1));
  const size_t begin = comparisonBegin(line, half ? at - 1 : at);
  if (begin == 0) return "";
  size_t end = at + 1;
  while (end < line.size() && line.type(end) != Lexer::KW_THEN && !isJoin(line.type(end)) &&
         line.type(end) != Lexer::RPAREN && !isText(line.type(end)) && !isClause(line.type(end)) &&
         line.type(end) != Lexer::KW_AT)
    ++end;
  const size_t sign = comparisonIn(line, begin, half ? at - 1 : at);
  if (half) {
    const bool asks = line.type(begin) == Lexer::KW_GIVEN;
    const std::string subject = line.text(begin + (asks ? 1 : 0), std::min(sign, at - 1));
    return fmt::format("`{}` joins two whole comparisons; write `{} {} {}`", line.word(at - 1),
                       line.text(begin, at), subject, line.text(at, end));
  }
  if (sign == at) return "";
  const size_t middle =
      line.type(sign) == Lexer::KW_IS && line.type(sign + 1) == Lexer::KW_NOT ? sign + 2 : sign + 1;
  return fmt::format("a comparison has two sides; write `{} and {} {}`", line.text(begin, at),
                     line.text(middle, at), line.text(at, end));
}

// `if limit given then`, `if limit is not given then`, `if limit exists then`.
std::string asked(const Line& line) {
  const size_t at = line.at();
  constexpr std::array<std::string_view, 5> kWords = {"exists", "defined", "present", "known", "passed"};
  const auto isAsked = [&](size_t i) {
    return line.type(i) == Lexer::KW_GIVEN ||
           (line.type(i) == Lexer::NAME &&
            std::find(kWords.begin(), kWords.end(), line.word(i)) != kWords.end());
  };
  // The word that asks is the one that does not fit, or the one before it, whose name is missing.
  size_t asks = at;
  if (!isAsked(asks) && line.type(at) == Lexer::KW_NOT && isAsked(at + 1)) asks = at + 1;
  if (!isAsked(asks) && at > 0 && line.type(at - 1) == Lexer::KW_GIVEN) asks = at - 1;
  if (!isAsked(asks) || asks < 2) return "";
  size_t name = asks - 1;
  const bool no = line.type(name) == Lexer::KW_NOT;
  if (no) --name;
  if (line.type(name) == Lexer::KW_IS && name > 1) --name;
  if (line.type(name) != Lexer::NAME || name == 0) return "";
  return fmt::format("whether the caller has given a value is asked by `given` before its name; write "
                     "`{} {}given {}{}`",
                     first(line, name), no ? "not " : "", line.word(name), after(line.rest(asks + 1)));
}

// ---- statements ------------------------------------------------------------------------------------------

// `set G54: side becomes x 0 mm, y 0 mm`, `becomes x = 0 mm`.
std::string becomes(const Line& line) {
  const size_t at = line.at();
  if (line.type(0) != Lexer::KW_SET || at >= line.size()) return "";
  const bool again = line.find(Lexer::KW_BECOMES) < at;
  if (again && line.type(at) == Lexer::AXIS && line.type(at - 1) == Lexer::COMMA)
    return fmt::format("each axis says what was measured; write `{} top.at becomes {}`", first(line, at),
                       line.rest(at));
  if (again && line.type(at) == Lexer::EQUALS && line.type(at - 1) == Lexer::AXIS)
    return fmt::format("no `=` is between an axis and its value; write `{} {}`", first(line, at),
                       line.rest(at + 1));
  return "";
}

std::string touchParts(const Line& line) {
  const size_t at = line.at();
  if (line.type(0) != Lexer::KW_TOUCH || at < 2 || at >= line.size()) return "";
  const size_t arrow = line.find(Lexer::ARROW);
  if (line.type(at) == Lexer::KW_FEED) {
    size_t end = at + 1;
    while (end < line.size() && line.type(end) != Lexer::ARROW && line.type(end) != Lexer::KW_ELSE &&
           line.type(end) != Lexer::KW_OVERTRAVEL)
      ++end;
    return fmt::format("a touch takes the machine's `measuring_feed`, and none of its own; write `{}{}`",
                       first(line, at), after(line.rest(end)));
  }
  if (line.type(at) == Lexer::KW_OVERTRAVEL && arrow < at) {
    const size_t otherwise = line.find(Lexer::KW_ELSE, at);
    return fmt::format("`overtravel` comes before `->`; write `{} {} {}{}`", first(line, arrow),
                       line.text(at, otherwise), line.text(arrow, at), after(line.rest(otherwise)));
  }
  if (line.type(at) == Lexer::COMMA && line.type(at + 1) == Lexer::AXIS &&
      line.find(Lexer::KW_ALONG) == line.size())
    return fmt::format("a touch goes along one axis, or along a direction: `touch along x 1, y 1 by 10 mm{}`",
                       after(line.rest(std::min(arrow, line.size()))));
  return "";
}

// `move to G53 z 0 mm`, `move to G55 x 5 mm`, `set G60: ..`.
std::string framed(const Line& line) {
  const size_t at = line.at();
  const std::string code = line.word(at);
  if (at == 0 || code.size() < 2 || code[0] != 'G') return "";
  const size_t move = line.type(0) == Lexer::KW_MOVE ? 0 : 1;
  if (line.type(move) == Lexer::KW_MOVE) {
    const bool machine = code == "G53", work = line.type(at) == Lexer::WORK_OFFSET;
    if (!machine && !work) return "";
    const std::string frame = machine ? "machine" : "work " + code;
    const size_t reach = line.type(move + 1) == Lexer::KW_MACHINE ? move : move + 1;
    const bool first = at <= reach + 1;
    const bool again = line.type(at - 1) == Lexer::KW_MACHINE;
    const std::string target = line.type(at + 1) == Lexer::AXIS ? line.rest(at + 1)
                               : first || again                 ? "z 0 mm"
                                                                : line.text(reach + 1, at);
    const size_t end = again ? at - 1 : line.type(at + 1) == Lexer::AXIS ? at : std::min(reach + 1, at);
    const std::string_view to = end == move + 1 ? " to" : "";
    return fmt::format("a coordinate {} is written with `{}`; write `{}{} {} {}`",
                       machine ? "of the machine" : "in another work offset", machine ? "machine" : "work",
                       line.text(0, end), to, frame, target);
  }
  const bool wanted =
      isOneOf<4>(line.type(at - 1), {Lexer::KW_SET, Lexer::KW_WORK, Lexer::EQUALS, Lexer::KW_IS});
  if (!wanted || line.type(at) != Lexer::CODE) return "";
  return fmt::format("`{}` is no work offset; those are `G54` to `G59`", code);
}

// `move to x 5 mm y 10 mm`, `move machine z 0 mm`.
std::string movedParts(const Line& line) {
  const size_t at = line.at(), move = line.type(0) == Lexer::KW_MOVE ? 0 : 1;
  if (line.type(move) != Lexer::KW_MOVE || at >= line.size()) return "";
  const bool frame = line.type(at) == Lexer::KW_MACHINE || line.type(at) == Lexer::KW_WORK;
  if (at == move + 1 && frame) return fmt::format("write `{} to {}`", first(line, at), line.rest(at));
  if (at > move + 3 && (frame || line.type(at) == Lexer::AXIS) && endsStatement(line.type(at - 1)))
    return fmt::format("a comma is between coordinates; write `{}, {}`", first(line, at), line.rest(at));
  return "";
}

// `1_000`, `1'000`, `1 000`.
std::string digits(const Line& line) {
  const size_t at = line.at();
  if (at == 0 || line.type(at - 1) != Lexer::NUMBER) return "";
  const std::string word = line.word(at);
  std::string rest = word.starts_with('_') ? word.substr(1) : "";
  if (word == "'" && line.type(at + 1) == Lexer::NUMBER) rest = line.word(at + 1);
  const bool apart = line.type(at) == Lexer::NUMBER || line.type(at) == Lexer::COMMA_NUMBER;
  if (apart) rest = word;
  std::replace(rest.begin(), rest.end(), ',', '.');
  const bool group = rest.size() >= 3 && std::all_of(rest.begin(), rest.begin() + 3, isDigit) &&
                     (apart || line.joins(at - 1));
  if (!group) return "";
  return fmt::format("the digits of a number are written together; write `{}{}`", line.word(at - 1), rest);
}

} // namespace

bool isForeignUnit(std::string_view word) {
  constexpr std::array<std::string_view, 16> kUnits = {"cm",      "dm",  "m",    "um",   "inch", "inches",
                                                       "zoll",    "mil", "thou", "grad", "rad",  "degree",
                                                       "degrees", "sec", "ms",   "min"};
  return std::find(kUnits.begin(), kUnits.end(), word) != kUnits.end();
}

std::string foreignPart(const Line& line) {
  for (const auto& form : {digits, framed, becomes, asked, compared})
    if (std::string message = form(line); !message.empty()) return message;
  return "";
}

std::string foreignOrder(const Line& line) {
  for (const auto& form : {named, ranged, untitled, ordered, touchParts, movedParts, several})
    if (std::string message = form(line); !message.empty()) return message;
  return "";
}

} // namespace dotek::frontend::cycle
