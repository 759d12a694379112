#include "frontend/macrob/Slips.h"

#include "frontend/macrob/Keywords.h"
#include "support/Ascii.h"
#include "support/NearestName.h"
#include "support/messages/Common.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::frontend::macrob {

using Lexer = grammar::MacroBLexer;

namespace {

using View = std::string_view;

// Words of other languages that make the flow of a program, and what Macro B has in their place.
struct FlowWord {
  View word, instead;
};
constexpr std::array kFlowWords = {
    FlowWord{"ELSEIF", "jump to a second IF: `IF[..]GOTO10`, and number its block N10"},
    FlowWord{"ELSIF", "jump to a second IF: `IF[..]GOTO10`, and number its block N10"},
    FlowWord{"ELSE", "end the first part with a GOTO over this one, and let IF jump here: `IF[..]GOTO10`"},
    FlowWord{"ENDIF", "IF rules one block; let it jump over several: `IF[..]GOTO10`"},
    FlowWord{"ENDWHILE", "a loop ends with END and the number of its DO: `END1`"},
    FlowWord{"ENDFOR", "a loop ends with END and the number of its DO: `END1`"},
    FlowWord{"WEND", "a loop ends with END and the number of its DO: `END1`"},
    FlowWord{"NEXT", "a loop ends with END and the number of its DO: `END1`"},
    FlowWord{"FOR", "count with a variable: `#1=1`, then `WHILE[#1LE5]DO1` .. `#1=#1+1` .. `END1`"},
    FlowWord{"REPEAT", "write `WHILE[..]DO1` .. `END1`, or jump back with IF and GOTO"},
    FlowWord{"UNTIL", "write `WHILE[..]DO1` .. `END1`, or jump back with IF and GOTO"},
    FlowWord{"BREAK", "leave the loop with `GOTO` to a block after its END"},
    FlowWord{"CONTINUE", "jump with `GOTO` to a numbered block before the END"},
    FlowWord{"RETURN", "a subprogram returns with `M99`"},
    FlowWord{"GOSUB", "call a program with `M98P..`, or with arguments by `G65P..`"},
    FlowWord{"CALL", "call a program with `M98P..`, or with arguments by `G65P..`"},
    FlowWord{"ENDSUB", "a subprogram returns with `M99`"},
};

struct Spelling {
  View written, meant;
};
// Words of conditions and values as other languages spell them.
constexpr std::array kSpellings = {
    Spelling{"LTE", "LE"},      Spelling{"LEQ", "LE"},       Spelling{"GTE", "GE"},
    Spelling{"GEQ", "GE"},      Spelling{"EQU", "EQ"},       Spelling{"EQL", "EQ"},
    Spelling{"IS", "EQ"},       Spelling{"NEQ", "NE"},       Spelling{"EG", "EQ"},
    Spelling{"ET", "AND"},      Spelling{"NULL", "#0"},      Spelling{"EMPTY", "#0"},
    Spelling{"VACANT", "#0"},   Spelling{"SQR", "SQRT"},     Spelling{"SQUARE", "SQRT"},
    Spelling{"INT", "FIX"},     Spelling{"TRUNC", "FIX"},    Spelling{"RND", "ROUND"},
    Spelling{"RUND", "ROUND"},  Spelling{"ARCTAN", "ATAN"},  Spelling{"ARCSIN", "ASIN"},
    Spelling{"ARCCOS", "ACOS"}, Spelling{"DPRINT", "DPRNT"},
};
constexpr std::array<View, 6> kKeywordsOfConditions = {"EQ", "NE", "GT", "GE", "LT", "LE"};
constexpr std::array<View, 22> kLongKeywords = {
    "THEN", "GOTO", "WHILE", "AND",   "XOR", "MOD", "SIN",   "COS",   "TAN",   "ASIN",  "ACOS",
    "ATAN", "SQRT", "ABS",   "ROUND", "FIX", "FUP", "POPEN", "PCLOS", "DPRNT", "BPRNT", "SETVN"};

View signMeant(View sign) {
  constexpr std::array<Spelling, 24> kSigns = {
      {{"=", "EQ"},   {"==", "EQ"}, {"===", "EQ"},   {"<", "LT"},         {">", "GT"},
       {"<=", "LE"},  {"=<", "LE"}, {">=", "GE"},    {"=>", "GE"},        {"<>", "NE"},
       {"><", "NE"},  {"!=", "NE"}, {"=!", "NE"},    {"~=", "NE"},        {"&", "AND"},
       {"&&", "AND"}, {"|", "OR"},  {"||", "OR"},    {"^", "POW[..,..]"}, {"**", "POW[..,..]"},
       {"%", "MOD"},  {":=", "="},  {"+=", "=#..+"}, {"-=", "=#..-"}}};
  const auto at =
      std::find_if(kSigns.begin(), kSigns.end(), [&](const Spelling& s) { return s.written == sign; });
  return at == kSigns.end() ? View() : at->meant;
}

class SlipFinder {
public:
  SlipFinder(const std::vector<Tok>& tokens, FileId file, View source, std::uint32_t end, bool first)
      : tokens_(tokens), file_(file), source_(source), end_(end), first_(first) {}

  std::optional<Diagnostic> run() const {
    if (tokens_.empty()) return std::nullopt;
    if (auto out = unread()) return out;
    if (auto out = header()) return out;
    if (auto out = flowWord()) return out;
    if (auto out = glued()) return out;
    if (auto out = sign()) return out;
    if (auto out = spelling()) return out;
    if (auto out = roundBrackets()) return out;
    if (auto out = joinedComparisons()) return out;
    if (auto out = gotoForm()) return out;
    if (auto out = whileAlone()) return out;
    if (auto out = thenAlone()) return out;
    if (auto out = textBehind()) return out;
    if (auto out = letterForOne()) return out;
    if (auto out = letterOInCall()) return out;
    return twoValues();
  }

private:
  // Words of a control that Dotek does not read: nothing of them is to be corrected.
  std::optional<Diagnostic> unread() const {
    const auto letter = [&](std::size_t i, char c) {
      return isAddress(type(i)) && (source_[tokens_[i].begin] & ~0x20) == c;
    };
    const auto told = [&](std::size_t first, std::size_t last, const char* what) {
      return makeDiagnostic<diag::SyntaxError>(range(tokens_[first].begin, tokens_[last].end), what);
    };
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (type(i) == Lexer::COMMA && depthAt(i) == 0 && (letter(i + 1, 'C') || letter(i + 1, 'R')))
        return told(
            i, i + 1,
            "`,C` is a chamfer and `,R` a rounding at the corner to the next block, where the control "
            "has them; Dotek does not read them, so it cannot run or check this block; the points of "
            "the chamfer, or an arc, say the same");
      if (letter(i, 'P') && letter(i + 1, 'R') && letter(i + 2, 'M') && type(i + 3) == Lexer::LBRACKET)
        return told(
            i, i + 2,
            "`PRM[..]` is the value of a parameter of the machine, where the control has it; Dotek does "
            "not read it, as no file says what the parameters of a machine are; put the value into a "
            "common variable for a run here");
      if (source_[tokens_[i].begin] == '<' && depthAt(i) == 0 && callsBefore(i))
        return told(
            i, i,
            "a program that is called by its name, where the control has that; Dotek follows calls by "
            "number alone; call the program by its O number");
    }
    return std::nullopt;
  }

  // `M98`, `G65`, and an optional P right before `i`.
  bool callsBefore(std::size_t i) const {
    if (i > 0 && isAddress(type(i - 1)) && (source_[tokens_[i - 1].begin] & ~0x20) == 'P') --i;
    if (i < 2 || type(i - 1) != Lexer::NUMBER || !isAddress(type(i - 2))) return false;
    const char address = static_cast<char>(source_[tokens_[i - 2].begin] & ~0x20);
    const std::string& code = tokens_[i - 1].text;
    return (address == 'M' && (code == "98" || code == "198")) ||
           (address == 'G' && (code == "65" || code == "66" || code == "66.1"));
  }

  std::size_t type(std::size_t i) const { return typeAt(tokens_, i); }
  SourceRange rangeOf(std::size_t i) const { return {file_, tokens_[i].begin, tokens_[i].end}; }
  SourceRange range(std::size_t begin, std::size_t end) const {
    return {file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }
  View between(std::size_t begin, std::size_t end) const { return source_.substr(begin, end - begin); }
  bool adjacent(std::size_t i) const {
    return i + 1 < tokens_.size() && tokens_[i].end == tokens_[i + 1].begin;
  }
  int depthAt(std::size_t end) const {
    int depth = 0;
    for (std::size_t i = 0; i < end; ++i)
      depth += type(i) == Lexer::LBRACKET ? 1 : type(i) == Lexer::RBRACKET ? -1 : 0;
    return depth;
  }
  std::size_t bodyBegin() const {
    std::size_t i = 0;
    if (type(i) == Lexer::SLASH) i += type(i + 1) == Lexer::NUMBER ? 2 : 1;
    if (type(i) == Lexer::ADDRESS_N && type(i + 1) == Lexer::NUMBER) i += 2;
    return i;
  }
  bool isConditional() const {
    return type(bodyBegin()) == Lexer::KW_IF || type(bodyBegin()) == Lexer::KW_WHILE;
  }
  std::size_t find(std::initializer_list<std::size_t> wanted, std::size_t from = 0) const {
    for (std::size_t i = from; i < tokens_.size(); ++i)
      if (std::find(wanted.begin(), wanted.end(), type(i)) != wanted.end()) return i;
    return tokens_.size();
  }
  // Where the action of an IF or WHILE begins.
  std::size_t actionBegin() const {
    return find({Lexer::KW_THEN, Lexer::KW_GOTO, Lexer::KW_DO}, bodyBegin());
  }

  template <class Id, class... Args>
  static Diagnostic make(SourceRange range, std::string title, std::vector<Edit> edits, const Args&... args) {
    Diagnostic one = makeDiagnostic<Id>(range, args...);
    if (!edits.empty()) one.fix = Fix{Fix::Applicability::Display, std::move(title), std::move(edits)};
    return one;
  }

  // The letters without blanks that hold the token `i`.
  SourceRange runOf(std::size_t i) const {
    std::size_t begin = tokens_[i].begin;
    std::size_t end = begin;
    while (begin > 0 && isLetter(source_[begin - 1]))
      --begin;
    while (end < source_.size() && isLetter(source_[end]))
      ++end;
    return range(begin, end);
  }
  std::string run(SourceRange where) const { return upperCase(between(where.begin, where.end)); }
  // Indices of the tokens that begin a run.
  template <class Look> std::optional<Diagnostic> eachRun(Look&& look) const {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (type(i) == Lexer::PRINT_TEXT || !isLetter(source_[tokens_[i].begin])) continue;
      const SourceRange where = runOf(i);
      if (where.begin != tokens_[i].begin) continue;
      if (auto out = look(i, where, run(where))) return out;
    }
    return std::nullopt;
  }
  // The first byte after `at` that is no blank; 0 at the end.
  char nextAfter(std::size_t at) const {
    while (at < end_ && (source_[at] == ' ' || source_[at] == '\t'))
      ++at;
    return at < end_ ? source_[at] : '\0';
  }

  // `01000(PART)`
  std::optional<Diagnostic> header() const {
    if (!first_ || tokens_.size() != 1 || type(0) != Lexer::NUMBER) return std::nullopt;
    const std::string& digits = tokens_[0].text;
    if (digits.size() < 4 || digits.size() > 9 || digits.find('.') != std::string::npos) return std::nullopt;
    const std::string number = digits[0] == '0' ? digits.substr(1) : digits;
    return make<diag::HeaderLetter>(rangeOf(0), fmt::format("write `O{}`", number),
                                    {{rangeOf(0), "O" + number}}, digits, number);
  }

  std::optional<Diagnostic> flowWord() const {
    return eachRun(
        [&](std::size_t, SourceRange where, const std::string& letters) -> std::optional<Diagnostic> {
          for (const FlowWord& one : kFlowWords) {
            if (!letters.starts_with(one.word)) continue;
            const View rest = View(letters).substr(one.word.size());
            const bool begins =
                rest.empty() || wordAt(rest).kind == WordKind::If || wordAt(rest).kind == WordKind::Goto;
            if (!begins) continue;
            // `NEXT TOOL` is text.
            const std::size_t behind = where.begin + one.word.size();
            const bool loose = one.word == "NEXT" || one.word == "CALL" || one.word == "RETURN" ||
                               one.word == "FOR" || one.word == "REPEAT" || one.word == "BREAK" ||
                               one.word == "CONTINUE" || one.word == "UNTIL";
            if (loose && isLetter(nextAfter(behind)) && nextAfter(behind) != 'O') continue;
            return makeDiagnostic<diag::FlowWordUnknown>(range(where.begin, behind), one.word, one.instead);
          }
          return std::nullopt;
        });
  }

  // `M30%`, `M99O0810`, `TAN 30`
  std::optional<Diagnostic> glued() const {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (i > 0 && i + 1 == tokens_.size() && depthAt(i) == 0 && source_[tokens_[i].begin] == '%' &&
          type(i - 1) == Lexer::NUMBER)
        return makeDiagnostic<diag::SyntaxError>(
            rangeOf(i),
            "`%` begins and ends the text of programs and stays alone on its line; write it on the "
            "next line");
      if (type(i) == Lexer::ADDRESS_O && i > 1 && type(i - 1) == Lexer::NUMBER && isAddress(type(i - 2)) &&
          (source_[tokens_[i - 2].begin] & ~0x20) == 'M' && type(i + 1) == Lexer::NUMBER)
        return makeDiagnostic<diag::SyntaxError>(
            range(tokens_[i].begin, tokens_[i + 1].end),
            "the number of a program begins it, on a line of its own; the control takes this one for a word "
            "of the block before, or stops with an alarm; write it on the next line");
      if (type(i) == Lexer::FUNCTION && type(i + 1) == Lexer::NUMBER)
        return make<diag::SyntaxError>(range(tokens_[i].begin, tokens_[i + 1].end),
                                       "put the operand into brackets",
                                       {{range(tokens_[i].begin, tokens_[i + 1].end),
                                         fmt::format("{}[{}]", tokens_[i].text, tokens_[i + 1].text)}},
                                       fmt::format("the operand of a function is in brackets; write `{}[{}]`",
                                                   tokens_[i].text, tokens_[i + 1].text));
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> sign() const {
    const bool conditional = isConditional();
    const std::size_t action = conditional ? actionBegin() : 0;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const char c = source_[tokens_[i].begin];
      if (type(i) == Lexer::PRINT_TEXT || View("<>=!~&|^%:*+-").find(c) == View::npos) continue;
      std::size_t end = tokens_[i].begin;
      const View allowed = c == '*' || c == '+' || c == '-' ? View("*=+-") : View("<>=!~&|^%:");
      while (end < end_ && allowed.find(source_[end]) != View::npos)
        ++end;
      const View written = between(tokens_[i].begin, end);
      const bool comparison =
          conditional && i < action && (depthAt(i) > 0 || type(bodyBegin() + 1) != Lexer::LBRACKET);
      if (written == "=" && !comparison) continue;
      const bool assigns = !comparison && depthAt(i) == 0 && (written == "==" || written == "===");
      const View meant = assigns ? View("=") : signMeant(written);
      if (meant.empty()) continue;
      const SourceRange where = range(tokens_[i].begin, end);
      const std::string text(meant);
      return make<diag::SignUnknown>(where, fmt::format("write `{}`", text),
                                     text.find("..") == std::string::npos ? std::vector<Edit>{{where, text}}
                                                                          : std::vector<Edit>{},
                                     written, text);
    }
    return std::nullopt;
  }

  bool isWholeKeyword(View letters) const {
    while (!letters.empty()) {
      const WordMatch word = wordAt(letters);
      if (word.kind == WordKind::Address) return false;
      letters.remove_prefix(word.length);
    }
    return true;
  }

  std::optional<Diagnostic> spelling() const {
    const std::size_t begin = bodyBegin();
    return eachRun([&](std::size_t i, SourceRange where,
                       const std::string& letters) -> std::optional<Diagnostic> {
      if (letters.size() < 2 || isWholeKeyword(letters)) return std::nullopt;
      const char next = nextAfter(where.end);
      // `XABS[#1]`
      const View behind = View(letters).substr(1);
      if (next == '[' && depthAt(i) == 0 && wordAt(behind).kind == WordKind::Function &&
          wordAt(behind).length == behind.size() && wordAt(letters).kind == WordKind::Address)
        return makeDiagnostic<diag::SyntaxError>(
            where, fmt::format("the value of `{0}` is a calculation; put it into brackets, `{0}[{1}[..]]`",
                               letters[0], behind));
      const bool operand =
          next == '[' || next == '#' || next == '(' || isDigit(next) || next == '-' || next == '.';
      // Text outside of brackets may hold the same words.
      const bool inside = depthAt(i) > 0 || isConditional() || next == '[' || next == '(' || next == '#';
      std::string meant;
      for (const Spelling& one : kSpellings)
        if (letters == one.written && inside) meant = one.meant;
      if (meant.empty() && depthAt(i) > 0 && letters.size() == 2 && operand)
        for (const View one : kKeywordsOfConditions)
          if (meant.empty() && nameDistance(letters, one, 1) <= 1 && letters[1] == one[1]) meant = one;
      if (meant.empty() && letters.size() >= 3 && (operand || next == ']' || (next == '\0' && i > begin))) {
        NearestName near(letters);
        for (const View one : kLongKeywords)
          near.offer(one);
        meant = near.result();
      }
      if (meant.empty()) return std::nullopt;
      return make<diag::WordUnknown>(where, fmt::format("write `{}`", meant), {{where, meant}},
                                     between(where.begin, where.end), meant);
    });
  }

  // `SIN(30.)`: what is in round brackets is a comment.
  std::optional<Diagnostic> roundBrackets() const {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const bool value = type(i) == Lexer::FUNCTION || type(i) == Lexer::KW_IF ||
                         type(i) == Lexer::KW_WHILE || type(i) == Lexer::EQUALS || isAddress(type(i)) ||
                         isOperator(type(i));
      if (!value) continue;
      std::size_t open = tokens_[i].end;
      while (open < end_ && (source_[open] == ' ' || source_[open] == '\t'))
        ++open;
      if (open >= end_ || source_[open] != '(') continue;
      std::size_t close = source_.find(')', open);
      if (close >= end_) continue;
      // The comment ends at the first `)`; the operand at the one that matches.
      int depth = 0;
      for (std::size_t at = open; at < end_; ++at) {
        depth += source_[at] == '(' ? 1 : source_[at] == ')' ? -1 : 0;
        if (depth != 0) continue;
        close = at;
        break;
      }
      const View inside = between(open + 1, close);
      const std::size_t lead = inside.find_first_not_of(" \t");
      if (lead == View::npos) continue;
      const char c = inside[lead];
      if (!isDigit(c) && View("#[.+-(").find(c) == View::npos &&
          wordAt(upperCase(inside)).kind != WordKind::Function)
        continue;
      const SourceRange where = range(open, close + 1);
      std::vector<Edit> edits;
      for (std::size_t at = open; at <= close; ++at)
        if (source_[at] == '(' || source_[at] == ')')
          edits.push_back({range(at, at + 1), source_[at] == '(' ? "[" : "]"});
      return make<diag::RoundBrackets>(where, "write square brackets", std::move(edits),
                                       between(where.begin, where.end), inside);
    }
    return std::nullopt;
  }

  std::size_t closeOf(std::size_t open) const {
    int depth = 0;
    for (std::size_t i = open; i < tokens_.size(); ++i) {
      depth += type(i) == Lexer::LBRACKET ? 1 : type(i) == Lexer::RBRACKET ? -1 : 0;
      if (depth == 0) return i;
    }
    return tokens_.size();
  }

  // `IF[#1EQ5AND#2EQ3]`, `IF[#1EQ5]AND[#2EQ3]`
  std::optional<Diagnostic> joinedComparisons() const {
    const std::size_t begin = bodyBegin();
    if (!isConditional() || type(begin + 1) != Lexer::LBRACKET) return std::nullopt;
    const std::size_t close = closeOf(begin + 1);
    if (close == tokens_.size()) return std::nullopt;
    const auto joins = [&](std::size_t i) {
      return type(i) == Lexer::KW_AND || type(i) == Lexer::KW_OR || type(i) == Lexer::KW_XOR;
    };
    int depth = 0;
    std::size_t relations = 0, joiner = tokens_.size();
    for (std::size_t i = begin + 1; i < close; ++i) {
      depth += type(i) == Lexer::LBRACKET ? 1 : type(i) == Lexer::RBRACKET ? -1 : 0;
      if (depth != 1) continue;
      if (type(i) == Lexer::RELATION) ++relations;
      if (joins(i) && joiner == tokens_.size()) joiner = i;
    }
    if (relations >= 2 && joiner < tokens_.size()) {
      std::vector<Edit> edits = {{range(tokens_[begin + 1].end, tokens_[begin + 1].end), "["}};
      depth = 0;
      for (std::size_t i = begin + 1; i < close; ++i) {
        depth += type(i) == Lexer::LBRACKET ? 1 : type(i) == Lexer::RBRACKET ? -1 : 0;
        if (depth != 1 || !joins(i)) continue;
        edits.push_back({range(tokens_[i - 1].end, tokens_[i - 1].end), "]"});
        edits.push_back({range(tokens_[i].end, tokens_[i].end), "["});
      }
      edits.push_back({range(tokens_[close].begin, tokens_[close].begin), "]"});
      return make<diag::JoinedComparisons>(rangeOf(joiner), "give each comparison its brackets",
                                           std::move(edits), tokens_[joiner].text);
    }
    if (!joins(close + 1)) return std::nullopt;
    const std::size_t action = actionBegin();
    if (action >= tokens_.size() || type(action - 1) != Lexer::RBRACKET) return std::nullopt;
    return make<diag::JoinedComparisons>(rangeOf(close + 1), "put both into one pair of brackets",
                                         {{range(tokens_[begin + 1].begin, tokens_[begin + 1].begin), "["},
                                          {range(tokens_[action - 1].end, tokens_[action - 1].end), "]"}},
                                         tokens_[close + 1].text);
  }

  // `GOTO N10`, `IF[..]N10`
  std::optional<Diagnostic> gotoForm() const {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (type(i) != Lexer::ADDRESS_N || type(i + 1) != Lexer::NUMBER || i == 0) continue;
      const std::string number = tokens_[i + 1].text;
      if (type(i - 1) == Lexer::KW_GOTO)
        return make<diag::GotoForm>(rangeOf(i), fmt::format("write `GOTO{}`", number), {{rangeOf(i), ""}},
                                    "the number of the block alone", number);
      if (type(bodyBegin()) == Lexer::KW_IF &&
          (type(i - 1) == Lexer::RBRACKET || type(i - 1) == Lexer::KW_THEN))
        return make<diag::GotoForm>(rangeOf(i), fmt::format("write `GOTO{}`", number), {{rangeOf(i), "GOTO"}},
                                    "`GOTO` before the number", number);
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> whileAlone() const {
    const std::size_t begin = bodyBegin();
    if (type(begin) != Lexer::KW_WHILE || type(begin + 1) != Lexer::LBRACKET) return std::nullopt;
    if (closeOf(begin + 1) + 1 != tokens_.size()) return std::nullopt;
    const std::uint32_t end = tokens_.back().end;
    return make<diag::WhileWithoutDo>(spanning(rangeOf(begin), rangeOf(tokens_.size() - 1)), "write `DO1`",
                                      {{range(end, end), "DO1"}});
  }

  // `IF[..]THEN` with its statements on the lines below.
  std::optional<Diagnostic> thenAlone() const {
    const std::size_t begin = bodyBegin();
    if (type(begin) != Lexer::KW_IF || type(begin + 1) != Lexer::LBRACKET) return std::nullopt;
    const std::size_t close = closeOf(begin + 1);
    if (close >= tokens_.size()) return std::nullopt;
    const bool then = type(close + 1) == Lexer::KW_THEN;
    if (close + (then ? 2u : 1u) != tokens_.size()) return std::nullopt;
    return makeDiagnostic<diag::IfOverBlocks>(spanning(rangeOf(begin), rangeOf(tokens_.size() - 1)));
  }

  // `#3000=1 NO PROBE`, `#1=5. RADIUS`
  std::optional<Diagnostic> textBehind() const {
    const std::size_t begin = bodyBegin();
    const bool assignment =
        type(begin) == Lexer::HASH && type(begin + 1) == Lexer::NUMBER && type(begin + 2) == Lexer::EQUALS;
    if (!assignment) return std::nullopt;
    const bool alarm = tokens_[begin + 1].text == "3000" || tokens_[begin + 1].text == "3006";
    for (std::size_t i = begin + 3; i < tokens_.size(); ++i) {
      if (!isLetter(source_[tokens_[i].begin]) || depthAt(i) != 0) continue;
      if (type(i - 1) != Lexer::NUMBER && type(i - 1) != Lexer::RBRACKET) continue;
      const SourceRange where = runOf(i);
      const std::string letters = run(where);
      if (letters.size() < (alarm ? 1u : 3u) || isWholeKeyword(letters)) continue;
      const SourceRange text = range(where.begin, tokens_.back().end);
      if (between(text.begin, text.end).find_first_of("()[]=") != View::npos) return std::nullopt;
      return make<diag::TextBehindStatement>(
          text, "put it into round brackets",
          {{range(text.begin, text.begin), "("}, {range(text.end, text.end), ")"}},
          between(text.begin, text.end));
    }
    return std::nullopt;
  }

  // `Xl0`, `X1l.5`, `XI0`
  std::optional<Diagnostic> letterForOne() const {
    for (std::size_t i = 1; i < tokens_.size(); ++i) {
      const char c = source_[tokens_[i].begin];
      if ((c != 'l' && c != 'I') || tokens_[i].end != tokens_[i].begin + 1 || !adjacent(i - 1)) continue;
      const bool digitsFollow = adjacent(i) && (type(i + 1) == Lexer::NUMBER || type(i + 1) == Lexer::POINT);
      const bool bare = type(i + 1) != Lexer::NUMBER && type(i + 1) != Lexer::HASH &&
                        type(i + 1) != Lexer::LBRACKET && type(i + 1) != Lexer::MINUS &&
                        type(i + 1) != Lexer::PLUS;
      // A longer row of letters is a word.
      const bool alone = i < 2 || !adjacent(i - 2) || !isLetter(source_[tokens_[i - 2].begin]);
      const bool behindAddress = alone && (isAddress(type(i - 1)) || type(i - 1) == Lexer::HASH);
      const bool behindNumber = type(i - 1) == Lexer::NUMBER && (c == 'l' || bare);
      if (!(behindAddress && (digitsFollow || (bare && c == 'l'))) &&
          !(behindNumber && (digitsFollow || bare)))
        continue;
      return make<diag::LetterForOne>(rangeOf(i), "write `1`", {{rangeOf(i), "1"}}, std::string(1, c));
    }
    return std::nullopt;
  }

  // `G65P9001A1.O5.`
  std::optional<Diagnostic> letterOInCall() const {
    const std::size_t begin = bodyBegin();
    const bool call = type(begin) == Lexer::ADDRESS && tokens_[begin].text == "G" &&
                      type(begin + 1) == Lexer::NUMBER &&
                      (tokens_[begin + 1].text == "65" || tokens_[begin + 1].text == "66");
    if (!call) return std::nullopt;
    for (std::size_t i = begin + 2; i + 1 < tokens_.size(); ++i) {
      if (type(i) != Lexer::ADDRESS_O || (type(i - 1) != Lexer::NUMBER && type(i - 1) != Lexer::RBRACKET))
        continue;
      const bool value =
          type(i + 1) == Lexer::NUMBER || type(i + 1) == Lexer::HASH || type(i + 1) == Lexer::LBRACKET;
      if (value) return makeDiagnostic<diag::LetterOOfCall>(rangeOf(i), tokens_[begin + 1].text);
    }
    return std::nullopt;
  }

  // `X-100. 100.`
  std::optional<Diagnostic> twoValues() const {
    for (std::size_t i = 1; i < tokens_.size(); ++i) {
      if (type(i) != Lexer::NUMBER || depthAt(i) != 0) continue;
      const std::string_view written = between(tokens_[i].begin, tokens_[i].end);
      const std::size_t blank = written.find_last_of(" \t");
      const bool twice = blank != View::npos && tokens_[i].text.find('.') != std::string::npos &&
                         (type(i + 1) == Lexer::POINT || type(i + 1) == Lexer::NUMBER);
      const bool apart =
          isAddress(type(i - 1)) && type(i + 1) == Lexer::NUMBER && tokens_[i + 1].begin > tokens_[i].end;
      if (!twice && !apart) continue;
      const std::size_t address = isAddress(type(i - 1))             ? i - 1
                                  : i >= 2 && isAddress(type(i - 2)) ? i - 2
                                                                     : tokens_.size();
      if (address == tokens_.size()) continue;
      const SourceRange second =
          twice ? range(tokens_[i].begin + blank + 1, tokens_[i + 1].end) : rangeOf(i + 1);
      return makeDiagnostic<diag::TwoValues>(second, tokens_[address].text,
                                             between(second.begin, second.end));
    }
    return std::nullopt;
  }

  const std::vector<Tok>& tokens_;
  FileId file_;
  View source_;
  std::uint32_t end_;
  bool first_;
};

} // namespace

std::optional<Diagnostic> findSlip(const std::vector<Tok>& tokens, FileId file, View source,
                                   std::uint32_t end, bool first) {
  return SlipFinder(tokens, file, source, end, first).run();
}

} // namespace dotek::frontend::macrob
