#include "frontend/cycle/Tokens.h"

#include "frontend/cycle/Foreign.h"
#include "frontend/cycle/Parse.h"
#include "frontend/cycle/Words.h"
#include "support/Ascii.h"
#include "support/Decimal.h"
#include "support/NearestName.h"

#include <CycleParser.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <string_view>

namespace dotek::frontend::cycle {

using Lexer = grammar::CycleLexer;
using Parser = grammar::CycleParser;

namespace {

struct Keyword {
  std::string_view text;
  size_t type = 0;
};

constexpr Keyword kWords[] = {
    {"cycle", Lexer::KW_CYCLE},
    {"options", Lexer::KW_OPTIONS},
    {"use", Lexer::KW_USE},
    {"needs", Lexer::KW_NEEDS},
    {"parameter", Lexer::KW_PARAMETER},
    {"result", Lexer::KW_RESULT},
    {"optional", Lexer::KW_OPTIONAL},
    {"require", Lexer::KW_REQUIRE},
    {"choice", Lexer::KW_CHOICE},
    {"of", Lexer::KW_OF},
    {"probe", Lexer::KW_PROBE},
    {"spindle", Lexer::KW_SPINDLE},
    {"coolant", Lexer::KW_COOLANT},
    {"on", Lexer::KW_ON},
    {"off", Lexer::KW_OFF},
    {"dwell", Lexer::KW_DWELL},
    {"stop", Lexer::KW_STOP},
    {"alarm", Lexer::KW_ALARM},
    {"report", Lexer::KW_REPORT},
    {"move", Lexer::KW_MOVE},
    {"rapid", Lexer::KW_RAPID},
    {"feed", Lexer::KW_FEED},
    {"protected", Lexer::KW_PROTECTED},
    {"to", Lexer::KW_TO},
    {"by", Lexer::KW_BY},
    {"start", Lexer::KW_START},
    {"here", Lexer::KW_HERE},
    {"machine", Lexer::KW_MACHINE},
    {"work", Lexer::KW_WORK},
    {"touch", Lexer::KW_TOUCH},
    {"set", Lexer::KW_SET},
    {"tool", Lexer::KW_TOOL},
    {"length", Lexer::KW_LENGTH},
    {"if", Lexer::KW_IF},
    {"then", Lexer::KW_THEN},
    {"else", Lexer::KW_ELSE},
    {"end", Lexer::KW_END},
    {"repeat", Lexer::KW_REPEAT},
    {"for", Lexer::KW_FOR},
    {"while", Lexer::KW_WHILE},
    {"call", Lexer::KW_CALL},
    {"given", Lexer::KW_GIVEN},
    {"is", Lexer::KW_IS},
    {"not", Lexer::KW_NOT},
    {"and", Lexer::KW_AND},
    {"or", Lexer::KW_OR},
    {"angle", Lexer::TYPE},
    {"time", Lexer::TYPE},
    {"count", Lexer::TYPE},
    {"ratio", Lexer::TYPE},
    {"flag", Lexer::TYPE},
    {"text", Lexer::TYPE},
    {"work_offset", Lexer::TYPE},
    {"tool_offset", Lexer::TYPE},
};

// Words only after an operand (a name, a number, a text, a bracket), else names.
constexpr Keyword kWordsAfterOperand[] = {
    {"nominal", Lexer::KW_NOMINAL},
    {"measured", Lexer::KW_MEASURED},
    {"tolerance", Lexer::KW_TOLERANCE},
    {"range", Lexer::KW_RANGE},
    {"group", Lexer::KW_GROUP},
    {"letter", Lexer::KW_LETTER},
    {"picture", Lexer::KW_PICTURE},
    {"overtravel", Lexer::KW_OVERTRAVEL},
    {"becomes", Lexer::KW_BECOMES},
    {"radius", Lexer::KW_RADIUS},
    {"times", Lexer::KW_TIMES},
    {"step", Lexer::KW_STEP},
    {"at", Lexer::KW_AT},
    {"length_wear", Lexer::KW_LENGTH_WEAR},
    {"radius_wear", Lexer::KW_RADIUS_WEAR},
};

// Words only after another word.
struct Follower {
  std::string_view text;
  size_t type = 0;
  size_t after = 0;
};
constexpr Follower kFollowers[] = {
    {"flood", Lexer::KW_FLOOD, Lexer::KW_COOLANT}, {"mist", Lexer::KW_MIST, Lexer::KW_COOLANT},
    {"stored", Lexer::KW_STORED, Lexer::KW_SET},   {"once", Lexer::KW_ONCE, Lexer::KW_TOUCH},
    {"along", Lexer::KW_ALONG, Lexer::KW_TOUCH},   {"along", Lexer::KW_ALONG, Lexer::KW_ONCE},
    {"most", Lexer::KW_MOST, Lexer::KW_AT},        {"measured", Lexer::KW_MEASURED, Lexer::TEXT},
};

template <class Table> size_t typeIn(const Table& table, std::string_view word) {
  for (const auto& entry : table)
    if (entry.text == word) return entry.type;
  return Lexer::NAME;
}

// Where a line goes on after one of these.
constexpr std::array kOpenEnds = {
    Lexer::COMMA,         Lexer::PLUS,    Lexer::MINUS,  Lexer::STAR,  Lexer::SLASH,  Lexer::LESS,
    Lexer::LESS_EQUAL,    Lexer::GREATER, Lexer::EQUALS, Lexer::COLON, Lexer::ARROW,  Lexer::GREATER_EQUAL,
    Lexer::FOREIGN_EQUAL, Lexer::KW_IS,   Lexer::KW_AND, Lexer::KW_OR, Lexer::KW_NOT,
};

// Begins a statement, and nothing else can: what is open before it ends.
constexpr std::array kBegins = {
    Lexer::KW_CYCLE, Lexer::KW_PARAMETER, Lexer::KW_RESULT,  Lexer::KW_PROBE,  Lexer::KW_SPINDLE,
    Lexer::KW_RAPID, Lexer::KW_PROTECTED, Lexer::KW_MOVE,    Lexer::KW_TOUCH,  Lexer::KW_SET,
    Lexer::KW_IF,    Lexer::KW_ELSE,      Lexer::KW_END,     Lexer::KW_REPEAT, Lexer::KW_FOR,
    Lexer::KW_WHILE, Lexer::KW_CALL,      Lexer::KW_ALARM,   Lexer::KW_STOP,   Lexer::KW_REPORT,
    Lexer::KW_DWELL, Lexer::KW_COOLANT,   Lexer::KW_OPTIONS,
};

template <class Types> bool isOneOf(size_t type, const Types& types) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

std::string misspelt(const std::string& word) {
  if (isForeignEnd(word)) return "a block ends with `end`";
  if (isForeignElseIf(word)) return "write `else if CONDITION then`";
  if (word == "goto" || word == "jump" || word == "label" || word == "return")
    return "there are no jumps; write what is to happen inside `if CONDITION then` .. `end`";
  if (word == "print" || word == "log" || word == "write" || word == "echo")
    return "a line of the protocol is `report \"Diameter\" measured size`";
  const std::string near = nearestName(word, statementWords());
  return near.empty() ? "" : fmt::format("did you mean `{}`?", near);
}

// Of the line that the token is in.
size_t firstOfLine(const antlr4::Token& token, const antlr4::Parser& parser) {
  auto& input = *const_cast<antlr4::Parser&>(parser).getTokenStream();
  size_t first = token.getTokenIndex();
  const auto endsLine = [&](size_t index) { return input.get(index)->getType() == Lexer::NEWLINE; };
  for (size_t at = first; at > 0 && !endsLine(at - 1); --at)
    if (input.get(at - 1)->getChannel() == antlr4::Token::DEFAULT_CHANNEL) first = at - 1;
  return first;
}

// Signs that look like what is meant, as mails, manuals and word processors write them.
struct ForeignSign {
  std::string_view text; // UTF-8
  std::string_view name; // with its number
  std::string_view write;
};
constexpr ForeignSign kForeignSigns[] = {
    {"\xC2\xA0", "a no-break space (U+00A0)", "write a blank"},
    {"\xE2\x80\xAF", "a narrow no-break space (U+202F)", "write a blank"},
    {"\xE2\x80\x87", "a figure space (U+2007)", "write a blank"},
    {"\xE2\x80\x89", "a thin space (U+2009)", "write a blank"},
    {"\xE3\x80\x80", "a wide space (U+3000)", "write a blank"},
    {"\xE2\x80\x8B", "a space without width (U+200B), which nobody sees", "take it out"},
    {"\xEF\xBB\xBF", "a byte order mark (U+FEFF), which nobody sees", "take it out"},
    {"\xE2\x88\x92", "a minus sign (U+2212)", "write `-`"},
    {"\xE2\x80\x90", "a hyphen (U+2010)", "write `-`"},
    {"\xE2\x80\x91", "a no-break hyphen (U+2011)", "write `-`"},
    {"\xE2\x80\x93", "a dash (U+2013)", "write `-`"},
    {"\xE2\x80\x94", "a dash (U+2014)", "write `-`"},
    {"\xC2\xAD", "a soft hyphen (U+00AD)", "write `-`, or take it out"},
    {"\xE2\x86\x92", "an arrow (U+2192)", "write `->`"},
    {"\xE2\x87\x92", "an arrow (U+21D2)", "write `->`"},
    {"\xEF\x83\xA0", "an arrow (U+F0E0)", "write `->`"},
    {"\xE2\x89\xA4", "the sign (U+2264) for less or equal", "write `<=`"},
    {"\xE2\x89\xA5", "the sign (U+2265) for greater or equal", "write `>=`"},
    {"\xE2\x89\xA0", "the sign (U+2260) for not equal", "write `is not`"},
    {"\xC2\xB0", "a degree sign (U+00B0)", "write ` deg`"},
    {"\xC2\xBA", "a raised o (U+00BA)", "write ` deg`"},
    {"\xC3\x97", "a multiplication sign (U+00D7)", "write `*`"},
    {"\xC2\xB7", "a middle dot (U+00B7)", "write `*`"},
    {"\xE2\x8B\x85", "a middle dot (U+22C5)", "write `*`"},
    {"\xC3\xB7", "a division sign (U+00F7)", "write `/`"},
    {"\xE2\x88\x95", "a division slash (U+2215)", "write `/`"},
    {"\xE2\x88\x9A", "a root sign (U+221A)", "write `sqrt(..)`"},
    {"\xC2\xB2", "a raised 2 (U+00B2)", "write `square(..)`"},
    {"\xC2\xB5", "the sign of micro (U+00B5)", "write mm: `0.005 mm`"},
    {"\xCE\xBC", "the letter mu (U+03BC)", "write mm: `0.005 mm`"},
    {"\xC2\xB1", "the sign (U+00B1) for plus or minus", "write the value and the tolerance apart"},
    {"\xE2\x80\xB3", "a double prime (U+2033)", "write ` in` for inches"},
    {"\xE2\x80\x9C", "a typographic quote (U+201C)", "write `\"`"},
    {"\xE2\x80\x9D", "a typographic quote (U+201D)", "write `\"`"},
    {"\xE2\x80\x9E", "a typographic quote (U+201E)", "write `\"`"},
    {"\xC2\xAB", "a typographic quote (U+00AB)", "write `\"`"},
    {"\xC2\xBB", "a typographic quote (U+00BB)", "write `\"`"},
    {"\xE2\x80\x98", "a typographic quote (U+2018)", "write a text in `\"`"},
    {"\xE2\x80\x99", "a typographic quote (U+2019)", "write a text in `\"`"},
};

// The first of them in the text; nullptr: there is none.
const ForeignSign* foreignSignOf(std::string_view text) {
  const ForeignSign* first = nullptr;
  std::size_t at = text.size();
  for (const ForeignSign& sign : kForeignSigns)
    if (const std::size_t found = text.find(sign.text); found < at) {
      at = found;
      first = &sign;
    }
  return first;
}

// How a message begins whose fault is the first word of the line, whatever comes after it.
constexpr std::string_view kNoStatement = "no statement begins with";

// 0: the text ends there.
char characterAfter(const antlr4::Token& token) {
  const size_t at = token.getStopIndex() + 1;
  if (token.getInputStream() == nullptr || at >= token.getInputStream()->size()) return 0;
  const std::string text =
      token.getInputStream()->getText({static_cast<ssize_t>(at), static_cast<ssize_t>(at)});
  return text.empty() ? '\0' : text.front();
}

// What hands write that know another language; "": none of these. `before`: the token before.
std::string foreignHabit(const antlr4::Token& offending, const antlr4::Token* before) {
  const std::string text = offending.getText();
  const bool afterNumber = before != nullptr && before->getType() == Lexer::NUMBER;
  if (offending.getType() == Lexer::OPEN_TEXT && afterNumber)
    return fmt::format("inches are written `in`: `{} in`", before->getText());
  if (text.starts_with('[') || text.starts_with(']'))
    return "there are no lists; give each value a name of its own, or compute it in the loop";
  if (text.starts_with('&')) return "write `and`";
  const bool afterValue =
      afterNumber || (before != nullptr && (before->getType() == Lexer::NAME || before->getText() == ")"));
  if (text.starts_with('|'))
    return afterValue || text.size() > 1 ? "write `or`" : "the size of a value without its sign is `abs(..)`";
  const char following = text.size() > 1 ? text[1] : characterAfter(offending);
  if (text.starts_with('#') && !(following >= '0' && following <= '9')) return "a comment begins with `//`";
  if (text.starts_with('#'))
    return "a cycle has no variables of the control; declare `result NAME : length`, and name the variable "
           "when it is converted: `--result NAME=#500`";
  const bool opens = before != nullptr && (before->getText() == "then" || before->getText() == "else");
  if (opens && offending.getType() != Lexer::NEWLINE && text != "if")
    return fmt::format("what is to happen is in the lines after `{}`, and `end` closes them; write `{}` in a "
                       "line of its own",
                       before->getText(), text);
  return "";
}

// What is wrong with a line that the grammar does not take, at its first token that does not fit.
std::string explain(const antlr4::Token& offending, const antlr4::Parser& parser) {
  auto& input = *const_cast<antlr4::Parser&>(parser).getTokenStream();
  const size_t first = firstOfLine(offending, parser);
  const antlr4::Token& head = *input.get(first);
  const std::string word = head.getText();
  const std::string text = offending.getText();
  const size_t type = offending.getType();
  const std::string_view usage = usageOf(lowerCase(word));
  const std::string write = usage.empty() ? "" : fmt::format("; write {}", usage);
  for (const std::string& one : {text, word})
    if (const ForeignSign* sign = one.starts_with('"') ? nullptr : foreignSignOf(one))
      return fmt::format("this is {}; {}", sign->name, sign->write);
  if (type != Lexer::OPEN_TEXT)
    if (std::string meant = foreignForm(Line(offending, input, first)); !meant.empty()) return meant;
  size_t last = offending.getTokenIndex();
  while (last > first && input.get(--last)->getChannel() != antlr4::Token::DEFAULT_CHANNEL) {
  }
  const antlr4::Token* const before =
      last < offending.getTokenIndex() && input.get(last)->getChannel() == antlr4::Token::DEFAULT_CHANNEL
          ? input.get(last)
          : nullptr;
  if (const std::string habit = foreignHabit(offending, before); !habit.empty()) return habit;
  if (type == Lexer::OPEN_TEXT) return "the text has no closing quote; write `\"` at its end";
  if (first + 1 >= input.size()) input.LT(2); // it may not have been read yet
  const size_t next = first + 1 < input.size() ? input.get(first + 1)->getType() : antlr4::Token::EOF;
  const bool second = first + 1 == offending.getTokenIndex();
  if (text == ";" || text == "!" || text == "{" || text == "'" || text == "%")
    return fmt::format("`{}` has no meaning; a comment begins with `//`, a text is in `\"`", text);
  if (type == Lexer::MINUS && (word == "parameter" || word == "result" || word == "cycle" || word == "call"))
    return "a name has `_` between its words, no `-`";
  if (type == Lexer::ODD_NAME && unitOf(lowerCase(text)))
    return fmt::format("units are written small: `{}`", lowerCase(text));
  if (second && type == Lexer::EQUALS && isReserved(word))
    return fmt::format("`{0}` is a word of the language, so nothing can be called that; write `{1}`", word,
                       proposeName(word));
  if (&head == &offending || (head.getType() == Lexer::NAME && second)) {
    if (isReserved(word) && next == Lexer::EQUALS)
      return fmt::format("`{0}` is a word of the language, so nothing can be called that; write `{1}`", word,
                         proposeName(word));
    if (head.getType() == Lexer::NAME) {
      const std::string hint = misspelt(word);
      return fmt::format("{} `{}`; {}", kNoStatement, word,
                         hint.empty() ? "a value is given as `name = value`" : hint);
    }
    if (head.getType() == Lexer::CODE || head.getType() == Lexer::WORK_OFFSET)
      return fmt::format("`{}` is G code, which no cycle holds; write what is to happen: `rapid move to x "
                         "5 mm`, `touch z to 0 mm -> top`, `probe on`",
                         word);
    if (head.getType() == Lexer::ODD_NAME)
      return fmt::format("names are written small, with `_` between words: `{}`", proposeName(word));
    if (&head == &offending) return fmt::format("{} `{}`", kNoStatement, type == Lexer::NEWLINE ? "" : word);
  }
  if (type == Lexer::NEWLINE || type == antlr4::Token::EOF)
    return fmt::format("the line ends before the statement is complete{}", write);
  if (type == Lexer::CODE && head.getText() == "parameter" &&
      std::string_view("TDH").find(text[0]) != std::string_view::npos)
    return fmt::format("a tool offset is given by its number: write `{}`", text.substr(1));
  if (type == Lexer::CODE && std::string_view("XYZABC").find(text[0]) == std::string_view::npos)
    return fmt::format("`{}` is G code, which no cycle holds{}", text, write);
  if (type == Lexer::CODE)
    return fmt::format("`{}` is G code; in a cycle coordinates are written `x 5 mm`{}", text, write);
  if (type == Lexer::ODD_NAME && (word == "stop" || word == "alarm" || word == "report"))
    return fmt::format("a text is in `\"`{}", write);
  if (type == Lexer::ODD_NAME && text.size() == 1 &&
      std::string_view("XYZABC").find(text) != std::string_view::npos)
    return fmt::format("axes are written small: `{}`", lowerCase(text));
  if (type == Lexer::ODD_NAME)
    return fmt::format("names are written small, with `_` between words: `{}`", proposeName(text));
  // `12 cm`: what follows a number is its unit.
  const size_t at = offending.getTokenIndex();
  if (text == "ms" && before != nullptr && before->getType() == Lexer::NUMBER)
    return fmt::format("times are in seconds: write `{} s`",
                       numberText(std::atof(before->getText().c_str()) / 1000));
  if (isForeignUnit(text) && before != nullptr && before->getType() == Lexer::NUMBER)
    return fmt::format("`{}` is no unit of the language; those are mm, in, deg, mm/min, in/min and s", text);
  // A value that has been called like one: `s.error`.
  if (at + 1 >= input.size()) input.LT(2);
  if (type != Lexer::NAME && isReserved(text) && at + 1 < input.size() && input.get(at + 1)->getText() == ".")
    return fmt::format("`{0}` is a word of the language, so nothing can be called that; write `{1}`", text,
                       proposeName(text));
  return fmt::format("`{}` does not fit here{}", text, write);
}

} // namespace

bool TokenReader::goesOn() const {
  return depth_ > 0 || isOneOf(previous_, kOpenEnds);
}

bool TokenReader::operandEnded() const {
  switch (previous_) {
  case NAME:
  case ODD_NAME:
  case NUMBER:
  case COMMA_NUMBER:
  case UNIT:
  case WORK_OFFSET:
  case TEXT:
  case TYPE:
  case KW_LENGTH:
  case KW_FEED:
  case KW_OPTIONAL:
  case KW_START:
  case KW_HERE:
  case RPAREN: return true;
  default: return false;
  }
}

void TokenReader::classify(antlr4::CommonToken& word) {
  const std::string text = word.getText();
  if (previous_ == DOT) {
    if (word.getType() == WORD || word.getType() == UNIT) word.setType(NAME);
    return;
  }
  if (word.getType() != WORD) return;
  for (const Follower& follower : kFollowers)
    if (previous_ == follower.after && follower.text == text) return word.setType(follower.type);
  if (operandEnded())
    if (const size_t known = typeIn(kWordsAfterOperand, text); known != NAME) return word.setType(known);
  if (const size_t known = typeIn(kWords, text); known != NAME) return word.setType(known);
  if (text.size() == 1 && std::string_view("xyzabc").find(text) != std::string_view::npos)
    return word.setType(AXIS);
  if (isName(text)) return word.setType(NAME);
  // `IF`, `End`: the word, written as in other languages.
  const std::string small = lowerCase(text);
  if (const size_t known = typeIn(kWords, small); known != NAME && text.size() > 1) {
    capitals_.emplace_back(word.getStartIndex(), word.getStopIndex());
    return word.setType(known);
  }
  word.setType(ODD_NAME);
}

std::unique_ptr<antlr4::Token> TokenReader::read() {
  std::unique_ptr<antlr4::Token> next = CycleLexer::nextToken();
  if (next->getChannel() == antlr4::Token::DEFAULT_CHANNEL)
    classify(static_cast<antlr4::CommonToken&>(*next));
  return next;
}

// `NAME =` after a line whose bracket is open and which no comma or operator ends: an assignment begins, as
// no `=` is within brackets.
bool TokenReader::givesValue(std::size_t before) {
  if (isOneOf(before, kOpenEnds) || before == LPAREN) return false;
  previous_ = NAME;
  while (true) {
    queue_.push_back(read());
    const antlr4::Token& found = *queue_.back();
    if (found.getChannel() == antlr4::Token::DEFAULT_CHANNEL) return found.getType() == EQUALS;
  }
}

std::unique_ptr<antlr4::Token> TokenReader::nextToken() {
  std::unique_ptr<antlr4::Token> next;
  const bool ahead = !queue_.empty();
  if (ahead) {
    next = std::move(queue_.front());
    queue_.pop_front();
  } else {
    next = read();
  }
  // A line end that was read ahead is the last of what was.
  if (!ahead || (queue_.empty() && next->getChannel() == antlr4::Token::DEFAULT_CHANNEL)) {
    const bool tooLong = next->getType() == NEWLINE && goesOn() && tokens_ > kStatementTokens;
    if (tooLong) tooLong_.push_back(next->getStartIndex());
    if (next->getType() == NEWLINE && goesOn() && !tooLong) {
      // What the next line begins with decides.
      const size_t before = previous_;
      previous_ = NEWLINE;
      size_t begin = antlr4::Token::EOF; // of the next line
      while (true) {
        queue_.push_back(read());
        antlr4::Token& found = *queue_.back();
        if (found.getChannel() != antlr4::Token::DEFAULT_CHANNEL) continue;
        if (found.getType() == NEWLINE) {
          static_cast<antlr4::CommonToken&>(found).setChannel(antlr4::Token::HIDDEN_CHANNEL);
          continue;
        }
        begin = found.getType();
        break;
      }
      const bool begins = isOneOf(begin, kBegins) || (begin == NAME && depth_ > 0 && givesValue(before));
      previous_ = before;
      if (!begins && begin != antlr4::Token::EOF)
        static_cast<antlr4::CommonToken&>(*next).setChannel(antlr4::Token::HIDDEN_CHANNEL);
    }
  }
  if (next->getChannel() != antlr4::Token::DEFAULT_CHANNEL) return next;
  const size_t kind = next->getType();
  if (kind == antlr4::Token::EOF) {
    if (previous_ == NEWLINE) return next;
    auto end = std::make_unique<antlr4::CommonToken>(static_cast<antlr4::CommonToken&>(*next));
    end->setType(NEWLINE);
    end->setStopIndex(end->getStartIndex() - 1);
    queue_.push_front(std::move(next));
    previous_ = NEWLINE;
    depth_ = 0;
    return end;
  }
  if (kind == LPAREN) ++depth_;
  if (kind == RPAREN && depth_ > 0) --depth_;
  if (kind == NEWLINE) depth_ = 0;
  tokens_ = kind == NEWLINE ? 0 : tokens_ + 1;
  previous_ = kind;
  return next;
}

Language language() {
  Language result;
  result.unitStops = {Lexer::NEWLINE};
  result.insertableAnywhere = {Lexer::RPAREN};
  result.opening = {Lexer::LPAREN};
  result.closing = {Lexer::RPAREN};
  result.depthResets = {Lexer::NEWLINE};
  result.explain = [](size_t, const antlr4::Token& offending, const antlr4::Parser& parser) {
    return explain(offending, parser);
  };
  result.place = [](const antlr4::Token& offending, const antlr4::Parser& parser) -> const antlr4::Token& {
    auto& input = *const_cast<antlr4::Parser&>(parser).getTokenStream();
    const size_t first = firstOfLine(offending, parser);
    const bool head =
        explain(offending, parser).starts_with(kNoStatement) || beginsForeign(Line(offending, input, first));
    return head ? *input.get(first) : offending;
  };
  return result;
}

bool isForeignEnd(std::string_view word) {
  constexpr std::array<std::string_view, 11> kEnds = {"endif",   "endwhile", "endfor",   "next",
                                                      "wend",    "done",     "end_if",   "end_while",
                                                      "end_for", "endcase",  "endswitch"};
  return std::find(kEnds.begin(), kEnds.end(), word) != kEnds.end();
}

bool isForeignElseIf(std::string_view word) {
  return word == "elseif" || word == "elsif" || word == "elif" || word == "else_if";
}

bool isForeignCase(std::string_view word) {
  return word == "case" || word == "select" || word == "switch" || word == "when";
}

} // namespace dotek::frontend::cycle
