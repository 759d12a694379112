#include "frontend/macrob/Misprints.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>

namespace dotek::frontend::macrob {

using Lexer = grammar::MacroBLexer;

namespace {

// Functions whose first two letters name no other.
constexpr std::array<std::string_view, 10> kShortened = {"SIN", "COS",   "TAN", "ATAN", "SQRT",
                                                         "ABS", "ROUND", "FIX", "FUP",  "ACOS"};

class Repairer {
public:
  Repairer(std::vector<Tok>& tokens, FileId file, std::string_view source, Forms forms)
      : tokens_(tokens), file_(file), source_(source), forms_(forms) {}

  Misprints run() {
    if (forms_.nestedComments) // of `(A (B))` the first bracket has closed the comment
      while (!tokens_.empty() && tokens_.back().type == Lexer::ANY && tokens_.back().text == ")")
        tokens_.pop_back();
    if (isText()) return {};
    spelling();
    shortWords();
    splitJoined();
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      degree(i);
      gotoWithZero(i);
      letterO(i);
      decimalComma(i);
    }
    bracketedAssignment();
    conditionBracket();
    missingThen();
    for (std::size_t i = 0; i < tokens_.size(); ++i)
      wordBrackets(i);
    const auto before = [](const Diagnostic& a, const Diagnostic& b) {
      return a.range.begin < b.range.begin;
    };
    std::stable_sort(out_.found.begin(), out_.found.end(), before);
    return std::move(out_);
  }

private:
  std::size_t type(std::size_t i) const { return typeAt(tokens_, i); }
  SourceRange rangeOf(const Tok& tok) const { return {file_, tok.begin, tok.end}; }
  SourceRange at(std::uint32_t place) const { return {file_, place, place}; }
  std::string textOf(SourceRange range) const {
    return std::string(source_.substr(range.begin, range.end - range.begin));
  }
  bool adjacent(std::size_t i) const {
    return i + 1 < tokens_.size() && tokens_[i].end == tokens_[i + 1].begin;
  }
  void erase(std::size_t first, std::size_t count = 1) {
    const auto begin = tokens_.begin() + static_cast<std::ptrdiff_t>(first);
    tokens_.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
  }
  void insert(std::size_t before, std::size_t tokenType, std::uint32_t place) {
    tokens_.insert(tokens_.begin() + static_cast<std::ptrdiff_t>(before),
                   Tok{tokenType, place, place, tokenType == Lexer::LBRACKET ? "[" : "]"});
  }
  template <class Id, class... Args>
  void report(SourceRange range, std::string title, std::vector<Edit> edits, const Args&... args) {
    Diagnostic one = makeDiagnostic<Id>(range, args...);
    if (!edits.empty()) one.fix = Fix{Fix::Applicability::Display, std::move(title), std::move(edits)};
    out_.found.push_back(std::move(one));
  }

  // Small letters and nothing that a block consists of: no misprint of a block.
  bool isText() const {
    bool small = false;
    for (const Tok& tok : tokens_) {
      switch (tok.type) {
      case Lexer::NUMBER:
      case Lexer::HASH:
      case Lexer::LBRACKET:
      case Lexer::EQUALS:
      case Lexer::PRINT_TEXT: return false;
      default: break;
      }
      for (const char c : textOf(rangeOf(tok)))
        small = small || std::islower(static_cast<unsigned char>(c)) != 0;
    }
    return small;
  }

  // ---- spelling

  // Small letters and blanks inside numbers: one remark each.
  void spelling() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const Tok& tok = tokens_[i];
      const std::string written = textOf(rangeOf(tok));
      if (tok.type == Lexer::NUMBER && written.find_first_of(" \t") != std::string::npos)
        out_.remarks.push_back(makeDiagnostic<diag::BlankInNumber>(rangeOf(tok), tok.text));
      const auto isSmall = [](unsigned char c) { return std::islower(c) != 0; };
      if (forms_.smallLetters || tok.type == Lexer::PRINT_TEXT ||
          std::none_of(written.begin(), written.end(), isSmall))
        continue;
      SourceRange range = rangeOf(tok);
      std::string capitals = tok.text;
      while (i + 1 < tokens_.size() && adjacent(i)) {
        const std::string next = textOf(rangeOf(tokens_[i + 1]));
        if (std::none_of(next.begin(), next.end(), isSmall)) break;
        capitals += tokens_[++i].text;
        range.end = tokens_[i].end;
      }
      Diagnostic remark = makeDiagnostic<diag::SmallLetter>(range, textOf(range));
      remark.fix = Fix{Fix::Applicability::Display, "write capitals", {{range, capitals}}};
      out_.remarks.push_back(std::move(remark));
    }
  }

  // `GO R5.`: letters that make OR or XOR between words.
  void splitJoined() {
    int depth = 0;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      depth += type(i) == Lexer::LBRACKET ? 1 : type(i) == Lexer::RBRACKET ? -1 : 0;
      if (type(i) == Lexer::EQUALS) return;
      const bool exclusive = type(i) == Lexer::KW_XOR;
      if (depth != 0 || (!exclusive && (type(i) != Lexer::KW_OR || i == 0 || !isAddress(type(i - 1)))))
        continue;
      const Tok whole = tokens_[i];
      const std::string written = textOf(rangeOf(whole));
      const auto o = static_cast<std::uint32_t>(whole.begin + written.find_first_of("Oo"));
      tokens_[i] = Tok{Lexer::ADDRESS, whole.end - 1, whole.end, "R"};
      tokens_.insert(tokens_.begin() + static_cast<std::ptrdiff_t>(i), Tok{Lexer::ADDRESS_O, o, o + 1, "O"});
      if (exclusive)
        tokens_.insert(tokens_.begin() + static_cast<std::ptrdiff_t>(i),
                       Tok{Lexer::ADDRESS, whole.begin, whole.begin + 1, "X"});
    }
  }

  void degree(std::size_t i) {
    if (type(i) != Lexer::DEGREE || i == 0) return;
    if (type(i - 1) != Lexer::NUMBER && type(i - 1) != Lexer::RBRACKET) return;
    const SourceRange range = rangeOf(tokens_[i]);
    report<diag::DegreeSign>(range, "leave the sign out", {{range, ""}});
    erase(i);
  }

  // `G0TO 5`
  void gotoWithZero(std::size_t i) {
    if (i + 3 >= tokens_.size() || type(i) != Lexer::ADDRESS || tokens_[i].text != "G" || !adjacent(i) ||
        tokens_[i + 1].text != "0" || !adjacent(i + 1) || tokens_[i + 2].text != "T" ||
        type(i + 3) != Lexer::ADDRESS_O)
      return;
    const SourceRange zero = rangeOf(tokens_[i + 1]);
    report<diag::ZeroForLetterO>(zero, "write `GOTO`", {{zero, "O"}});
    tokens_[i] = Tok{Lexer::KW_GOTO, tokens_[i].begin, tokens_[i + 3].end, "GOTO"};
    erase(i + 1, 3);
  }

  // Letters in a row that are no addresses with their zeros: `[your position]`, not `GOXOYO`.
  bool isInSentence(std::size_t i) const {
    constexpr std::size_t kShort = 4;
    std::size_t first = i, last = i;
    const auto letter = [&](std::size_t at) {
      return (isAddress(type(at)) || type(at) == Lexer::ADDRESS_O) &&
             tokens_[at].end == tokens_[at].begin + 1;
    };
    while (first > 0 && letter(first - 1) && adjacent(first - 1))
      --first;
    while (last + 1 < tokens_.size() && letter(last + 1) && adjacent(last))
      ++last;
    if (last - first + 1 < kShort) return false;
    for (std::size_t at = first; at <= last; ++at)
      if ((type(at) == Lexer::ADDRESS_O) != ((at - first) % 2 == 1)) return true;
    return false;
  }

  // `M99O0810`: the header of the next program on the line of an end.
  bool followsEnd(std::size_t i) const {
    if (i < 2 || tokens_[i - 2].text != "M" || i + 1 >= tokens_.size() || type(i + 1) != Lexer::NUMBER)
      return false;
    const std::string& code = tokens_[i - 1].text;
    return (code == "99" || code == "30" || code == "2" || code == "02") && tokens_[i + 1].text.size() >= 3;
  }

  // `GO X5.`, `AO.`, `1O.`: O where a digit belongs.
  void letterO(std::size_t i) {
    if (type(i) != Lexer::ADDRESS_O || i == 0) return;
    const bool behindNumber = type(i - 1) == Lexer::NUMBER && adjacent(i - 1);
    if (!behindNumber && !isAddress(type(i - 1)) && !expectsValue(type(i - 1)) && type(i - 1) != Lexer::HASH)
      return;
    if (isInSentence(i) || (behindNumber && followsEnd(i))) return;
    SourceRange letters = rangeOf(tokens_[i]);
    std::vector<Edit> edits = {{letters, "0"}};
    Tok number{Lexer::NUMBER, tokens_[i].begin, tokens_[i].end, "0"};
    std::size_t first = i;
    if (behindNumber) {
      first = i - 1;
      number.begin = tokens_[first].begin;
      number.text = tokens_[first].text + "0";
    }
    std::size_t last = i;
    bool digitsFollow = false;
    while (last + 1 < tokens_.size()) {
      const Tok& next = tokens_[last + 1];
      const bool pointFree = number.text.find('.') == std::string::npos;
      if (next.type == Lexer::ADDRESS_O && adjacent(last)) {
        edits.push_back({rangeOf(next), "0"});
        number.text += "0";
      } else if (next.type == Lexer::NUMBER && adjacent(last) &&
                 (pointFree || next.text.find('.') == std::string::npos)) {
        digitsFollow = digitsFollow || next.text.front() != '.';
        number.text += next.text;
      } else if (next.type == Lexer::POINT && pointFree) {
        number.text += ".";
      } else {
        break;
      }
      number.end = next.end;
      ++last;
    }
    const std::string address =
        isAddress(type(first - (first > 0))) && first > 0 ? tokens_[first - 1].text : "";
    // `GO5` may be short for GOTO5 as well.
    if (address == "G" && !behindNumber && digitsFollow) return;
    const std::string word = address + number.text;
    report<diag::LetterOForZero>(letters, fmt::format("write `{}`", word), edits, word);
    erase(first + 1, last - first);
    tokens_[first] = std::move(number);
  }

  // The function whose operands are at `i`; empty: none.
  std::string functionAround(std::size_t i) const {
    int depth = 0;
    while (i-- > 0) {
      if (type(i) == Lexer::RBRACKET) ++depth;
      if (type(i) != Lexer::LBRACKET || depth-- > 0) continue;
      return i > 0 && type(i - 1) == Lexer::FUNCTION ? tokens_[i - 1].text : "";
    }
    return "";
  }

  // `PRM[3201,5]`
  bool isInParameter(std::size_t i) const {
    while (i > 0 && type(i) != Lexer::LBRACKET)
      --i;
    return type(i) == Lexer::LBRACKET && i > 0 && isAddress(type(i - 1)) && tokens_[i - 1].text == "M";
  }

  void decimalComma(std::size_t i) {
    if (type(i) != Lexer::COMMA || i == 0 || type(i - 1) != Lexer::NUMBER || type(i + 1) != Lexer::NUMBER)
      return;
    Tok& left = tokens_[i - 1];
    const Tok& right = tokens_[i + 1];
    if ((left.text + right.text).find('.') != std::string::npos) return;
    const std::string function = functionAround(i);
    if (function == "ATAN" || function == "POW" || isInParameter(i)) return;
    const SourceRange range = rangeOf(tokens_[i]);
    left.text += "." + right.text;
    left.end = right.end;
    report<diag::DecimalComma>(range, fmt::format("write `{}`", left.text), {{range, "."}}, left.text);
    erase(i, 2);
  }

  // ---- short words

  // The first token of the statement.
  std::size_t body() const {
    std::size_t i = 0;
    if (type(i) == Lexer::SLASH) i += type(i + 1) == Lexer::NUMBER ? 2 : 1;
    if (type(i) == Lexer::ADDRESS_N && type(i + 1) == Lexer::NUMBER) i += 2;
    return i;
  }
  // `WH[..]DO1`, `EN1`, `SQ[..]` in a calculation: the editor of a Fanuc writes the words out as they are
  // typed; some controls read them in a file, too.
  void shortWords() {
    const std::size_t first = body();
    for (std::size_t i = first; i + 2 < tokens_.size(); ++i) {
      if (!isAddress(type(i)) || !isAddress(type(i + 1)) || !adjacent(i)) continue;
      const std::string letters = tokens_[i].text + tokens_[i + 1].text;
      const bool before = type(i + 2) == Lexer::LBRACKET;
      Tok whole{0, tokens_[i].begin, tokens_[i + 1].end, ""};
      if (letters == "WH" && i == first && before) {
        whole.type = Lexer::KW_WHILE;
        whole.text = "WHILE";
      } else if (letters == "EN" && i == first && type(i + 2) == Lexer::NUMBER && i + 3 == tokens_.size()) {
        whole.type = Lexer::KW_END;
        whole.text = "END";
      } else if (before && i > first && (expectsValue(type(i - 1)) || type(i - 1) == Lexer::EQUALS)) {
        for (const std::string_view name : kShortened)
          if (name.starts_with(letters)) whole.text = name;
        if (whole.text.empty()) continue;
        whole.type = Lexer::FUNCTION;
      } else {
        continue;
      }
      if (!forms_.shortWords)
        report<diag::ShortWord>(
            SourceRange{file_, whole.begin, whole.end}, fmt::format("write `{}`", whole.text),
            {{SourceRange{file_, whole.begin, whole.end}, whole.text}}, letters, whole.text);
      tokens_[i] = std::move(whole);
      erase(i + 1);
    }
  }

  // ---- brackets

  // The bracket that closes the one at `open`; tokens_.size(): none.
  std::size_t matching(std::size_t open) const {
    int depth = 0;
    for (std::size_t i = open; i < tokens_.size(); ++i) {
      depth += type(i) == Lexer::LBRACKET ? 1 : type(i) == Lexer::RBRACKET ? -1 : 0;
      if (depth == 0) return i;
    }
    return tokens_.size();
  }
  int balance(std::size_t first, std::size_t last) const {
    int depth = 0;
    for (std::size_t i = first; i < last; ++i)
      depth += type(i) == Lexer::LBRACKET ? 1 : type(i) == Lexer::RBRACKET ? -1 : 0;
    return depth;
  }

  // `[#1 = 2]`
  void bracketedAssignment() {
    std::size_t i = 0;
    while (i < tokens_.size() &&
           (type(i) == Lexer::ADDRESS_N || type(i) == Lexer::SLASH || type(i) == Lexer::NUMBER))
      ++i;
    if (type(i) != Lexer::LBRACKET || type(i + 1) != Lexer::HASH || type(i + 2) != Lexer::NUMBER ||
        type(i + 3) != Lexer::EQUALS || matching(i) + 1 != tokens_.size())
      return;
    const SourceRange open = rangeOf(tokens_[i]);
    const SourceRange close = rangeOf(tokens_.back());
    report<diag::BracketedAssignment>(spanning(open, close), "leave the brackets out",
                                      {{open, ""}, {close, ""}});
    tokens_.pop_back();
    erase(i);
  }

  // `IF [#1 AND 1] EQ 1] THEN`: the bracket after IF appears once, two are closed.
  void conditionBracket() {
    for (std::size_t i = 0; i + 1 < tokens_.size(); ++i) {
      if ((type(i) != Lexer::KW_IF && type(i) != Lexer::KW_WHILE) || type(i + 1) != Lexer::LBRACKET) continue;
      const std::size_t close = matching(i + 1);
      std::size_t end = i + 1;
      while (end < tokens_.size() && type(end) != Lexer::KW_THEN && type(end) != Lexer::KW_GOTO &&
             type(end) != Lexer::KW_DO)
        ++end;
      if (close + 1 >= end || type(end - 1) != Lexer::RBRACKET || balance(i + 1, end) != -1) return;
      if (type(close + 1) != Lexer::RELATION && !isOperator(type(close + 1))) return;
      const std::uint32_t place = tokens_[i + 1].begin;
      report<diag::ConditionBracketMissing>(rangeOf(tokens_[i]), "open the condition", {{at(place), "["}},
                                            tokens_[i].text);
      insert(i + 1, Lexer::LBRACKET, place);
      return;
    }
  }

  // `IF[..]#26=5.`
  void missingThen() {
    for (std::size_t i = 0; i + 1 < tokens_.size(); ++i) {
      if (type(i) != Lexer::KW_IF || type(i + 1) != Lexer::LBRACKET) continue;
      const std::size_t close = matching(i + 1);
      if (forms_.thenOptional && close + 1 < tokens_.size() &&
          (type(close + 1) == Lexer::HASH || type(close + 1) == Lexer::ADDRESS)) {
        const std::uint32_t place = tokens_[close + 1].begin;
        tokens_.insert(tokens_.begin() + static_cast<std::ptrdiff_t>(close + 1),
                       Tok{Lexer::KW_THEN, place, place, "THEN"});
        return;
      }
      if (close >= tokens_.size() || type(close + 1) != Lexer::HASH) return;
      const auto equals = std::any_of(tokens_.begin() + static_cast<std::ptrdiff_t>(close), tokens_.end(),
                                      [](const Tok& tok) { return tok.type == Lexer::EQUALS; });
      if (!equals) return;
      const std::uint32_t place = tokens_[close + 1].begin;
      Diagnostic remark = makeDiagnostic<diag::ThenMissing>(
          SourceRange{file_, tokens_[close].end - 1, tokens_[close + 1].end});
      remark.fix = Fix{Fix::Applicability::Display, "write `THEN`", {{at(place), "THEN"}}};
      out_.remarks.push_back(std::move(remark));
      tokens_.insert(tokens_.begin() + static_cast<std::ptrdiff_t>(close + 1),
                     Tok{Lexer::KW_THEN, place, place, "THEN"});
      return;
    }
  }

  // After the operand that begins at `i`; `i` itself: none does.
  std::size_t behindOperand(std::size_t i) const {
    if (type(i) == Lexer::NUMBER) return i + 1;
    const std::size_t bracket = type(i) == Lexer::HASH ? i + 1 : i;
    if (bracket > i && type(bracket) == Lexer::NUMBER) return bracket + 1;
    if (type(bracket) != Lexer::LBRACKET) return i;
    const std::size_t close = matching(bracket);
    return close == tokens_.size() ? i : close + 1;
  }

  // `X[#1]/[#2]`: the value of a word is one bracket.
  void wordBrackets(std::size_t i) {
    // What follows the number of a block is no part of it.
    if (!isAddress(type(i)) || tokens_[i].text == "N") return;
    std::size_t value = i + 1;
    if (type(value) == Lexer::MINUS || type(value) == Lexer::PLUS) ++value;
    const std::size_t behind = behindOperand(value);
    if (behind == value || !isOperator(type(behind))) return;
    // `/2` may be meant to skip the rest of the block.
    if (type(behind) == Lexer::SLASH && type(behind + 1) == Lexer::NUMBER) return;
    std::size_t end = behind;
    while (end < tokens_.size() && !isAddress(type(end)) && type(end) != Lexer::ADDRESS_O &&
           type(end) != Lexer::EQUALS && type(end) != Lexer::KW_IF && type(end) != Lexer::KW_GOTO)
      ++end;
    if (type(end) == Lexer::EQUALS || isOperator(type(end - 1))) return;
    const int depth = balance(value, end);
    const std::uint32_t open = tokens_[value].begin;
    const std::uint32_t close = tokens_[end - 1].end;
    const std::string address = tokens_[i].text;
    const SourceRange range{file_, tokens_[behind].begin, close};
    if (depth == 0) {
      report<diag::WordNeedsBrackets>(range, "put the whole value into brackets",
                                      {{at(open), "["}, {at(close), "]"}}, address);
      insert(end, Lexer::RBRACKET, close);
      insert(value, Lexer::LBRACKET, open);
    } else if (depth == -1 && type(end - 1) == Lexer::RBRACKET) {
      report<diag::WordNeedsBrackets>(range, "open the value with another bracket", {{at(open), "["}},
                                      address);
      insert(value, Lexer::LBRACKET, open);
    }
  }

  std::vector<Tok>& tokens_;
  FileId file_;
  std::string_view source_;
  Forms forms_;
  Misprints out_;
};

} // namespace

Misprints repairMisprints(std::vector<Tok>& tokens, FileId file, std::string_view source, Forms forms) {
  return Repairer(tokens, file, source, forms).run();
}

} // namespace dotek::frontend::macrob
