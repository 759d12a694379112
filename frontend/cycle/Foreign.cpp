#include "frontend/cycle/Foreign.h"

#include "frontend/cycle/Tokens.h"
#include "frontend/cycle/Words.h"
#include "support/Ascii.h"

#include <CycleLexer.h>

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::frontend::cycle {

using Lexer = grammar::CycleLexer;

Line::Line(const antlr4::Token& offending, antlr4::TokenStream& input, size_t first) {
  // What was read so far ends where the grammar gave up.
  constexpr ssize_t kMost = 100;
  for (ssize_t ahead = 1; ahead < kMost; ++ahead)
    if (const size_t type = input.LT(ahead)->getType(); type == Lexer::NEWLINE || type == antlr4::Token::EOF)
      break;
  for (size_t i = first; i < input.size(); ++i) {
    const antlr4::Token& token = *input.get(i);
    if (token.getType() == Lexer::NEWLINE && token.getChannel() == antlr4::Token::DEFAULT_CHANNEL) break;
    if (token.getType() == antlr4::Token::EOF) break;
    if (&token == &offending) at_ = words_.size();
    if (token.getChannel() == antlr4::Token::DEFAULT_CHANNEL) words_.push_back(&token);
  }
  if (at_ == 0 && (words_.empty() || words_.front() != &offending)) at_ = words_.size();
}

size_t Line::type(size_t i) const {
  return i < size() ? words_[i]->getType() : antlr4::Token::EOF;
}

std::string Line::word(size_t i) const {
  return i < size() ? words_[i]->getText() : "";
}

std::string Line::text(size_t from, size_t end) const {
  end = std::min(end, size());
  if (from >= end) return "";
  return words_[from]->getInputStream()->getText(
      antlr4::misc::Interval(words_[from]->getStartIndex(), words_[end - 1]->getStopIndex()));
}

size_t Line::find(size_t type, size_t from) const {
  while (from < size() && words_[from]->getType() != type)
    ++from;
  return from;
}

bool Line::joins(size_t i) const {
  return i + 1 < size() && words_[i]->getStopIndex() + 1 == words_[i + 1]->getStartIndex();
}

namespace {

template <size_t N> bool isAmong(std::string_view word, const std::array<std::string_view, N>& list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool isWord(const std::string& text) {
  return !text.empty() && (isLetter(text[0]) || text[0] == '_');
}

std::string nameFor(const std::string& word) {
  return isName(word) && !isReserved(word) ? word : proposeName(word);
}

bool declares(std::string_view word) {
  constexpr std::array<std::string_view, 17> kWords = {
      "let", "var",   "const", "int",    "float", "double", "real",     "auto", "def",
      "dim", "local", "bool",  "string", "long",  "number", "variable", "val"};
  return isAmong(word, kWords);
}

// Of a value, by a unit in it.
std::string_view kindIn(const Line& line, size_t from) {
  const std::optional<Unit> unit = unitOf(line.word(line.find(Lexer::UNIT, from)));
  if (unit == Unit::Millimetre || unit == Unit::Inch) return "length";
  if (unit == Unit::Degree) return "angle";
  if (unit == Unit::Second) return "time";
  if (unit == Unit::MillimetrePerMinute || unit == Unit::InchPerMinute) return "feed";
  return line.find(Lexer::TEXT, from) < line.size() ? "text" : "count";
}

// `left = touch ..`, `let left = touch ..`, `left -> touch ..`: what gives a name follows the statement.
std::string namedBefore(const Line& line) {
  const size_t begin = declares(line.word(0)) ? 1 : 0;
  if (!isWord(line.word(begin))) return "";
  size_t statement = begin + 1;
  const auto gives = [&](size_t i) {
    constexpr std::array<std::string_view, 7> kSigns = {"=", ":=", "==", "->", "<", "-", ":"};
    return isAmong(line.word(i), kSigns);
  };
  while (gives(statement))
    ++statement;
  const bool touch = line.type(statement) == Lexer::KW_TOUCH, call = line.type(statement) == Lexer::KW_CALL;
  if (begin == 0 && statement == 1 && line.type(0) != Lexer::NAME && line.type(0) != Lexer::AXIS) return "";
  if (!touch && !call) return "";
  const size_t arrow = line.find(Lexer::ARROW, statement);
  const size_t otherwise = line.find(Lexer::KW_ELSE, statement);
  const bool branches = otherwise < line.size();
  return fmt::format("a {} names what it {} after `->`; write `{} -> {}{}`", touch ? "touch" : "call",
                     touch ? "finds" : "gives", line.text(statement, std::min(arrow, otherwise)),
                     nameFor(line.word(begin)), branches ? " else" : "");
}

std::string declared(const Line& line) {
  if (!declares(line.word(0)) || line.at() > 1 || !isWord(line.word(1))) return "";
  const size_t type = line.type(2);
  const bool given = type == Lexer::EQUALS || type == Lexer::FOREIGN_EQUAL;
  return fmt::format("a value needs no declaration; write `{} = {}`{}", nameFor(line.word(1)),
                     given && line.size() > 3 ? line.rest(3) : "value", given ? "" : " where it gets one");
}

// `size := 3 mm`, `size += 1 mm`, `3 mm -> size`.
std::string given(const Line& line) {
  const std::string name = line.word(0);
  const bool isNamed = line.type(0) == Lexer::NAME;
  // As a value does.
  const auto goesOn = [](size_t type) {
    constexpr std::array<size_t, 8> kTypes = {Lexer::ARROW, Lexer::PLUS, Lexer::MINUS, Lexer::STAR,
                                              Lexer::SLASH, Lexer::DOT,  Lexer::UNIT,  Lexer::LPAREN};
    return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
  };
  const size_t arrow = line.find(Lexer::ARROW);
  if (line.at() <= 1 && arrow > 0 && arrow + 2 == line.size() && isWord(line.word(arrow + 1)) &&
      line.type(0) != Lexer::KW_TOUCH && line.type(0) != Lexer::KW_CALL && goesOn(line.type(1)))
    return fmt::format("a value is given with `=`: `{} = {}`", nameFor(line.word(arrow + 1)),
                       line.text(0, arrow));
  if (!isNamed || line.at() != 1) return "";
  if (line.type(1) == Lexer::FOREIGN_EQUAL)
    return fmt::format("a value is given with `=` alone: `{} = {}`", name,
                       line.size() > 2 ? line.rest(2) : "value");
  if (line.type(1) == Lexer::LESS && line.type(2) == Lexer::MINUS && line.joins(1) && line.size() > 3)
    return fmt::format("a value is given with `=`: `{} = {}`", name, line.rest(3));
  constexpr std::array<size_t, 4> kSigns = {Lexer::PLUS, Lexer::MINUS, Lexer::STAR, Lexer::SLASH};
  if (std::find(kSigns.begin(), kSigns.end(), line.type(1)) == kSigns.end() || !line.joins(1)) return "";
  const std::string sign = line.word(1);
  if (line.type(2) == Lexer::EQUALS && line.size() > 3)
    return fmt::format("a value is given with `=` alone: `{0} = {0} {1} {2}`", name, sign, line.rest(3));
  if (line.word(2) == sign && line.size() == 3)
    return fmt::format("a value is given with `=`: `{0} = {0} {1} 1`", name, sign);
  return "";
}

// `hole = bore diameter = 30 mm`, `bore diameter = 30 mm`, `call bore(diameter = 30 mm)`, `call bore 30 mm`.
std::string called(const Line& line) {
  const bool call = line.type(0) == Lexer::KW_CALL;
  if (call && line.type(1) == Lexer::NAME && line.type(2) == Lexer::LPAREN) {
    const size_t close = line.find(Lexer::RPAREN, 3);
    const std::string inner = line.text(3, close), after = line.rest(std::min(close + 1, line.size()));
    return fmt::format("what a call hands over is not in brackets; write `call {}{}{}{}{}`", line.word(1),
                       inner.empty() ? "" : " ", inner, after.empty() ? "" : " ", after);
  }
  if (call && line.at() == 2 &&
      (line.type(2) == Lexer::NUMBER || line.type(2) == Lexer::MINUS || line.type(2) == Lexer::COMMA_NUMBER))
    return fmt::format("a call names each parameter; write `call {} parameter = {}`", line.word(1),
                       line.rest(2));
  if (line.type(0) != Lexer::NAME) return "";
  if (line.at() == 1 && line.type(1) == Lexer::NAME && line.type(2) == Lexer::EQUALS)
    return fmt::format("a cycle is run by `call`; write `call {}`", line.rest(0));
  if (line.type(1) == Lexer::EQUALS && line.type(2) == Lexer::NAME && line.at() == 3 &&
      line.type(3) == Lexer::NAME && line.type(4) == Lexer::EQUALS)
    return fmt::format("a cycle is run by `call`, and names what it gives after `->`; write `call {} -> {}`",
                       line.text(2, line.find(Lexer::ARROW)), line.word(0));
  return "";
}

std::string commented(const Line& line) {
  const std::string first = line.word(0);
  const bool dashes = line.type(0) == Lexer::MINUS && line.type(1) == Lexer::MINUS;
  const bool star = line.type(0) == Lexer::SLASH && line.type(1) == Lexer::STAR;
  if (line.at() == 0 && (first == "#" || first == "(" || dashes || star || first == "*"))
    return "a comment begins with `//`, and ends with its line";
  if (line.at() == 0 && first.size() > 1 && first[0] == '#')
    return fmt::format(
        "`{0}` is a variable of a control, and a cycle has none; a value is given as `name = value`, "
        "and a variable named for a result when it is converted: `--result NAME={0}`",
        first);
  return "";
}

// `if size > 30 mm {`, `while size > 30 mm`, `repeat 3`, `for i in 1 to 4`.
std::string opened(const Line& line) {
  const std::string head = lowerCase(line.word(0));
  const std::string found = lowerCase(line.word(line.at()));
  const bool ends = line.at() >= line.size();
  constexpr std::array<std::string_view, 4> kOpeners = {":", "{", "do", ","};
  if (!ends && !isAmong(found, kOpeners) && found != "in") return "";
  const std::string inner = line.text(1, line.at());
  if (inner.empty()) return "";
  const bool again = head == "else" && line.type(1) == Lexer::KW_IF;
  if ((head == "if" || (again && line.size() > 2)) && found != ",")
    return fmt::format("a condition ends with `then`; write `{} {} then`", head, inner);
  if (head == "while" && found != "," && line.find(Lexer::KW_AT) == line.size())
    return fmt::format("a loop says how often it runs at most; write `while {} at most 10 times`", inner);
  if (head == "repeat" && line.find(Lexer::KW_TIMES) == line.size())
    return fmt::format("write `repeat {} times`", inner);
  if (head != "for" || ends) return "";
  const size_t last = line.at() + 1;
  if (found == "in" && line.find(Lexer::KW_TO, last) < line.size())
    return fmt::format("write `for {} = {}`", line.word(1), line.rest(last));
  if (found == "in" || (found == "," && line.find(Lexer::COMMA, last) < line.size()))
    return fmt::format("a loop counts from a first value to a last one, and goes through no list; write `for "
                       "{} = 1 to 4`",
                       line.word(1));
  return found == "," ? fmt::format("write `for {} to {}`", inner, line.rest(last))
                      : fmt::format("nothing follows the last value; write `for {}`", inner);
}

// `x5`: "x 5".
std::string split(const std::string& word) {
  const bool axis = word.size() > 1 && std::string_view("xyzabcXYZABC").find(word[0]) != std::string::npos;
  if (!axis || !isDigit(word[1])) return "";
  return fmt::format("{} {}", lowerCase(word.substr(0, 1)), word.substr(1));
}

std::string moved(const Line& line) {
  const auto isKind = [&](size_t i) {
    const size_t type = line.type(i);
    return type == Lexer::KW_RAPID || type == Lexer::KW_FEED || type == Lexer::KW_PROTECTED;
  };
  const size_t move = isKind(0) ? 1 : 0;
  if (move == 1 && line.type(1) != Lexer::KW_MOVE) {
    if (line.at() != 1) return "";
    const bool reach = line.type(1) == Lexer::KW_TO || line.type(1) == Lexer::KW_BY;
    if (reach || line.type(1) == Lexer::AXIS)
      return fmt::format("write `{} move {}{}`", line.word(0), reach ? "" : "to ", line.rest(1));
    return "";
  }
  if (line.type(move) != Lexer::KW_MOVE) return "";
  const size_t next = move + 1;
  const std::string head = line.text(0, next), found = line.word(line.at());
  if (isKind(next)) return fmt::format("write `{} move {}`", line.word(next), line.rest(next + 1));
  if (line.type(next) == Lexer::AXIS) {
    const bool late = line.type(next + 1) == Lexer::KW_BY || line.type(next + 1) == Lexer::KW_TO;
    if (late)
      return fmt::format("write `{} {} {} {}`", head, line.word(next + 1), line.word(next),
                         line.rest(next + 2));
    return fmt::format("`to` goes to a coordinate, `by` over a distance; write `{0} to {1}` or `{0} by {1}`",
                       head, line.rest(next));
  }
  if (line.type(next) != Lexer::KW_TO && line.type(next) != Lexer::KW_BY) return "";
  if (const std::string apart = split(found); !apart.empty() && line.type(line.at()) != Lexer::CODE)
    return fmt::format("a blank is between an axis and its value: `{} mm`", apart);
  if (line.type(line.at()) == Lexer::EQUALS && line.type(line.at() - 1) == Lexer::AXIS)
    return fmt::format("no `=` is between an axis and its value; write `{} {}`", line.text(0, line.at()),
                       line.rest(line.at() + 1));
  if (line.type(line.at()) == Lexer::NUMBER)
    return fmt::format("each value has its axis before it; write `{} x {}`", line.text(0, line.at()),
                       line.rest(line.at()));
  if (found.size() == 2 && (found[0] == 'd' || found[0] == 'D') && !split(found.substr(1) + "0").empty())
    return fmt::format("a distance is `by` with the axis alone; write `{} by {} {}`", head,
                       lowerCase(found.substr(1)), line.rest(line.at() + 1));
  return "";
}

std::string touched(const Line& line) {
  if (line.type(0) != Lexer::KW_TOUCH) return "";
  const size_t axis = line.type(1) == Lexer::KW_ONCE ? 2 : 1;
  const size_t found = line.type(line.at());
  const auto isSign = [](size_t type) { return type == Lexer::PLUS || type == Lexer::MINUS; };
  if (isSign(line.type(axis)) || (line.type(axis) == Lexer::AXIS && isSign(line.type(axis + 1))))
    return "the sign of the distance says which way: `touch x by 10 mm` or `touch x by -10 mm`";
  if (line.type(axis) == Lexer::AXIS && line.at() == axis + 1 &&
      (found == Lexer::NUMBER || found == Lexer::NAME))
    return fmt::format("`by` is the distance to the surface, `to` its coordinate; write `{0} by {1}` or "
                       "`{0} to {1}`",
                       line.text(0, line.at()), line.rest(line.at()));
  const size_t last = line.size() - 1;
  if (line.at() == axis && line.type(axis) == Lexer::NAME && line.type(axis + 1) == Lexer::AXIS)
    return fmt::format("the name of a touch follows it; write `touch {} -> {}`", line.rest(axis + 1),
                       line.word(axis));
  if (line.at() == last && line.at() > axis + 1 && (found == Lexer::NAME || found == Lexer::AXIS))
    return fmt::format("a touch names what it finds after `->`; write `{} -> {}`", line.text(0, last),
                       nameFor(line.word(last)));
  if (found == Lexer::DOT && line.type(line.at() - 2) == Lexer::ARROW)
    return fmt::format("a touch gets a name alone; write `{}`, and read `{}` after it",
                       line.text(0, line.at()), line.rest(line.at() - 1));
  return "";
}

std::string set(const Line& line) {
  if (line.type(0) != Lexer::KW_SET) return "";
  for (size_t i = 1; i <= line.at() && i < line.size(); ++i)
    if (line.word(i) == "wear")
      return "the wear of a tool offset is one word with what wears; write `set tool T length_wear "
             "T.length_wear + change` or `set tool T radius_wear ..`";
  const std::string tool = line.word(line.at());
  if (tool.size() > 1 && (tool[0] == 'T' || tool[0] == 'H' || tool[0] == 'D') && isDigit(tool[1]))
    return fmt::format("a tool offset is its number alone; write `set tool {} {}`", tool.substr(1),
                       line.rest(line.at() + 1));
  const bool named = line.type(1) == Lexer::NAME && line.type(2) == Lexer::COLON &&
                     line.type(3) == Lexer::AXIS && line.at() == 3;
  if (line.type(1) != Lexer::WORK_OFFSET && !named) return "";
  return fmt::format("a work offset is set by what gets which coordinate; write `set {}: right.at becomes x "
                     "0 mm`",
                     line.word(1));
}

// `parameter depth = 5 mm`, `parameter length depth`, `parameter depth length`.
std::string parameter(const Line& line) {
  const std::string head = line.word(0);
  if ((head != "parameter" && head != "result") || line.at() != 2) return "";
  const std::string one = line.word(1), two = line.word(2);
  if (line.type(2) == Lexer::EQUALS)
    return fmt::format("the kind of value is missing; write `{} {} : {} {}`", head, nameFor(one),
                       kindIn(line, 3), line.rest(2));
  const bool turned = typeOf(one) && isWord(two) && !typeOf(two);
  if (!turned && !typeOf(two)) return "";
  const std::string rest = line.rest(3);
  return fmt::format("the name comes first, its kind after `:`; write `{} {} : {}{}{}`", head,
                     nameFor(turned ? two : one), turned ? one : two, rest.empty() ? "" : " ", rest);
}

std::string computed(const Line& line) {
  const size_t at = line.at();
  if (at == 0 || at >= line.size()) return "";
  if (line.word(at) == "^" || (line.type(at) == Lexer::STAR && line.type(at - 1) == Lexer::STAR))
    return "there are no powers; write `square(value)`, or multiply";
  constexpr std::array<std::string_view, 14> kFunctions = {"abs",  "sqrt",  "sin",  "cos",   "tan",
                                                           "asin", "acos",  "atan", "min",   "max",
                                                           "up",   "round", "down", "square"};
  if (isAmong(line.word(at - 1), kFunctions))
    return fmt::format("what a function takes is in brackets; write `{}({})`", line.word(at - 1),
                       line.rest(at));
  return "";
}

std::string begun(const Line& line) {
  if (line.at() > 1) return "";
  const std::string head = lowerCase(line.word(0));
  constexpr std::array<std::string_view, 4> kWaits = {"wait", "sleep", "delay", "pause"};
  if (isAmong(head, kWaits)) return "a cycle waits by `dwell 0.5 s`, and for the operator by `stop \"text\"`";
  constexpr std::array<std::string_view, 7> kEnds = {"exit",  "quit",  "abort", "error",
                                                     "throw", "raise", "fail"};
  if (isAmong(head, kEnds))
    return "a run ends with `alarm \"what is wrong\"`; a cycle is over after its last line";
  constexpr std::array<std::string_view, 7> kRoutines = {"function", "sub",     "procedure", "proc",
                                                         "macro",    "routine", "func"};
  if (isAmong(head, kRoutines))
    return "what is used more than once is a cycle in a file of its own, `cycle NAME`, and run by `call "
           "NAME`";
  const auto holds = [&](std::string_view word) {
    for (size_t i = 1; i < line.size(); ++i)
      if (line.word(i) == word) return true;
    return false;
  };
  constexpr std::array<std::string_view, 5> kSwitches = {"turn", "switch", "enable", "disable", "activate"};
  if (isAmong(head, kSwitches) && (head != "switch" || holds("probe")))
    return "the probe is switched by `probe on` and `probe off`";
  if (isForeignCase(head))
    return "one of several cases is `if side is left then` .. `else if side is right then` .. `end`";
  constexpr std::array<std::string_view, 4> kLeaves = {"break", "continue", "leave", "last"};
  if (isAmong(head, kLeaves))
    return "nothing leaves a loop early; its condition ends it: `while CONDITION at most 10 times`";
  constexpr std::array<std::string_view, 9> kShows = {"message", "msg",    "display", "show",    "popup",
                                                      "prompt",  "dialog", "alert",   "operator"};
  if (isAmong(head, kShows))
    return "`stop \"text\"` shows a text and waits for the operator, `report \"Diameter\" measured size` "
           "writes a line of the protocol";
  // `probe_on`, `move_to x 5 mm`.
  if (const size_t gap = head.find('_'); gap != std::string::npos && line.type(1) != Lexer::EQUALS) {
    const std::string first = head.substr(0, gap);
    const auto known = statementWords();
    std::string words = head + (line.size() > 1 ? " " + line.rest(1) : "");
    std::replace(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(head.size()), '_', ' ');
    if (first != "end" && std::find(known.begin(), known.end(), first) != known.end())
      return fmt::format("the words of a statement are written apart; write `{}`", words);
  }
  constexpr std::array<std::string_view, 4> kSearches = {"measure", "search", "find", "contact"};
  if (isAmong(head, kSearches)) return "a surface is measured by `touch x by 10 mm -> NAME`";
  const bool code = head.size() > 1 && (head[0] == 'g' || head[0] == 'm') &&
                    std::all_of(head.begin() + 1, head.end(), isDigit);
  if (code && line.type(1) != Lexer::EQUALS)
    return fmt::format("`{}` is G code, which no cycle holds; write what is to happen: `rapid move to x 5 "
                       "mm`, `touch z to 0 mm -> top`, `probe on`",
                       line.word(0));
  return "";
}

} // namespace

bool beginsForeign(const Line& line) {
  return line.size() > 0 && namedBefore(line).empty() && (!declared(line).empty() || !begun(line).empty());
}

std::string foreignForm(const Line& line) {
  if (line.size() == 0) return "";
  for (const auto& form : {foreignPart, foreignValue, namedBefore, declared, called, given, commented, opened,
                           moved, touched, set, parameter, computed, begun, foreignOrder})
    if (std::string message = form(line); !message.empty()) return message;
  return "";
}

} // namespace dotek::frontend::cycle
