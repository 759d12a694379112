#include "frontend/macrob/Listing.h"

#include "frontend/macrob/Brackets.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace dotek::frontend::macrob {

using Lexer = grammar::MacroBLexer;

namespace {

std::uint32_t wholeNumber(const std::string& digits) {
  std::uint32_t value = UINT32_MAX;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

class Repairer {
public:
  Repairer(std::vector<Tok>& tokens, FileId file, std::string_view source, const UsesVariable& uses)
      : tokens_(tokens), file_(file), source_(source), uses_(uses) {}

  std::vector<Diagnostic> run() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      starForHash(i);
      pointedVariable(i);
      strayIf(i);
      sixForG(i);
      hashLost(i);
    }
    brackets();
    return std::move(found_);
  }

private:
  std::size_t type(std::size_t i) const { return typeAt(tokens_, i); }
  SourceRange rangeOf(const Tok& tok) const { return {file_, tok.begin, tok.end}; }
  void erase(std::size_t i) { tokens_.erase(tokens_.begin() + static_cast<std::ptrdiff_t>(i)); }
  template <class Id, class... Args>
  void report(SourceRange range, std::string title, std::vector<Edit> edits, const Args&... args) {
    Diagnostic one = makeDiagnostic<Id>(range, args...);
    one.fix = Fix{Fix::Applicability::Display, std::move(title), std::move(edits)};
    found_.push_back(std::move(one));
  }

  // `*130` and `**100` where a variable belongs.
  void starForHash(std::size_t i) {
    if (type(i) != Lexer::STAR || i == 0 || !expectsValue(type(i - 1)) || type(i + 1) != Lexer::NUMBER)
      return;
    const std::string& digits = tokens_[i + 1].text;
    if (digits.find('.') != std::string::npos || !uses_(wholeNumber(digits))) return;
    const SourceRange range = rangeOf(tokens_[i]);
    report<diag::StarForHash>(range, fmt::format("write `#{}`", digits), {{range, "#"}}, digits);
    tokens_[i].type = Lexer::HASH;
    tokens_[i].text = "#";
  }

  // `#54.` and `#106.`
  void pointedVariable(std::size_t i) {
    if (type(i) != Lexer::HASH || type(i + 1) != Lexer::NUMBER || !tokens_[i + 1].text.ends_with('.')) return;
    Tok& number = tokens_[i + 1];
    const std::uint32_t n = wholeNumber(number.text);
    const SourceRange range = spanning(rangeOf(tokens_[i]), rangeOf(number));
    if (n >= 34 && n <= 99) {
      report<diag::VariableNumberForm>(range, fmt::format("write `{}`", number.text),
                                       {{rangeOf(tokens_[i]), ""}}, number.text);
      erase(i);
    } else if (uses_(n)) {
      report<diag::VariableNumberForm>(range, fmt::format("write `#{}`", n),
                                       {{{file_, number.end - 1, number.end}, ""}}, number.text);
      number.text.pop_back();
    }
  }

  // `X5. IF #9` where F belongs.
  void strayIf(std::size_t i) {
    if (type(i) != Lexer::KW_IF || type(i + 1) != Lexer::HASH || type(i + 2) != Lexer::NUMBER) return;
    const bool words = i > 0 && std::any_of(tokens_.begin(), tokens_.begin() + static_cast<std::ptrdiff_t>(i),
                                            [](const Tok& tok) { return tok.type == Lexer::ADDRESS; });
    if (!words || (type(i + 3) != antlr4::Token::EOF && !isAddress(type(i + 3)))) return;
    const SourceRange range = rangeOf(tokens_[i]);
    report<diag::StrayIf>(range, fmt::format("write `F#{}`", tokens_[i + 2].text), {{range, "F"}},
                          tokens_[i + 2].text);
    tokens_[i].type = Lexer::ADDRESS;
    tokens_[i].text = "F";
  }

  // Where the digits after the last blank of a number begin; its own begin: it has none.
  std::uint32_t lastPart(const Tok& number) const {
    for (std::uint32_t at = number.end; at > number.begin; --at)
      if (source_[at - 1] == ' ' || source_[at - 1] == '\t') return at;
    return number.begin;
  }
  void insert(std::size_t before, Tok tok) {
    tokens_.insert(tokens_.begin() + static_cast<std::ptrdiff_t>(before), std::move(tok));
  }
  // The number in token `i` ends before `at`; false: nothing of it is left.
  bool cut(std::size_t i, std::uint32_t at) {
    Tok& number = tokens_[i];
    std::string text;
    for (std::uint32_t from = number.begin; from < at; ++from)
      if (source_[from] != ' ' && source_[from] != '\t') text += source_[from];
    number.text = text;
    while (at > number.begin && (source_[at - 1] == ' ' || source_[at - 1] == '\t'))
      --at;
    number.end = at;
    return !text.empty();
  }

  // `G00 643 H7`, `643 H7`: 6 where G belongs. A G word has no four digits, and H goes with G43 and G44.
  void sixForG(std::size_t i) {
    const bool ofGO = i > 1 && type(i - 1) == Lexer::ADDRESS_O && tokens_[i - 2].text == "G";
    if (type(i) != Lexer::NUMBER || (i > 0 && !isAddress(type(i - 1)) && !ofGO)) return;
    const std::uint32_t from = lastPart(tokens_[i]);
    const std::string code(source_.substr(from, tokens_[i].end - from));
    if (code.size() != 3 || code.front() != '6' || code.find_first_not_of("0123456789") != std::string::npos)
      return;
    const std::string digits = code.substr(1);
    const bool ofG = ofGO || (i > 0 && tokens_[i - 1].text == "G" && tokens_[i].text.size() > 3);
    const bool withH =
        isAddress(type(i + 1)) && tokens_[i + 1].text == "H" && (digits == "43" || digits == "44");
    const bool parted = from > tokens_[i].begin || i == 0 || ofGO;
    if (!parted || (!withH && !(ofG && digits >= "40"))) return;
    const SourceRange range{file_, from, tokens_[i].end};
    report<diag::SixForLetterG>(range, "write `G" + digits + "`", {{{file_, from, from + 1}, "G"}}, code,
                                digits);
    const std::uint32_t end = tokens_[i].end;
    const Tok letter{Lexer::ADDRESS, from, from + 1, "G"}, number{Lexer::NUMBER, from + 1, end, digits};
    if (cut(i, from)) {
      insert(i + 1, number);
      insert(i + 1, letter);
    } else {
      tokens_[i] = letter;
      insert(i + 1, number);
    }
  }

  // `5=#2`, `N10 5=#2`: only a variable takes a value.
  void hashLost(std::size_t i) {
    if (type(i) != Lexer::NUMBER || type(i + 1) != Lexer::EQUALS) return;
    const bool ofBlock = i == 1 && type(0) == Lexer::ADDRESS_N;
    const std::uint32_t from = lastPart(tokens_[i]);
    if (i != 0 && (!ofBlock || from == tokens_[i].begin)) return;
    const std::string digits(source_.substr(from, tokens_[i].end - from));
    if (digits.find_first_not_of("0123456789") != std::string::npos || !uses_(wholeNumber(digits))) return;
    const SourceRange range{file_, from, tokens_[i].end};
    report<diag::HashLost>(range, "write `#" + digits + "`", {{{file_, from, from}, "#"}}, digits);
    const Tok hash{Lexer::HASH, from, from, "#"}, number{Lexer::NUMBER, from, tokens_[i].end, digits};
    if (cut(i, from)) {
      insert(i + 1, number);
      insert(i + 1, hash);
    } else {
      tokens_[i] = number;
      insert(i, hash);
    }
  }

  // A bracket of the one value whose brackets do not match.
  void brackets() {
    const auto count = [&](std::size_t what) {
      return std::count_if(tokens_.begin(), tokens_.end(), [&](const Tok& one) { return one.type == what; });
    };
    const auto opened = count(Lexer::LBRACKET), closed = count(Lexer::RBRACKET);
    if (opened - closed != 1 && closed - opened != 1) return;
    for (const Tok& tok : tokens_) // conditions have brackets of their own
      if (tok.type == Lexer::KW_IF || tok.type == Lexer::KW_WHILE) return;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const bool word = isAddress(type(i)), assigned = type(i) == Lexer::EQUALS;
      if (!word && !assigned) continue;
      std::size_t end = i + 1;
      while (end < tokens_.size() && !isAddress(type(end)) && type(end) != Lexer::ADDRESS_O &&
             type(end) != Lexer::ADDRESS_N && type(end) != Lexer::EQUALS)
        ++end;
      const auto repair = bracketRepair(tokens_, i + 1, end, word);
      if (!repair) continue;
      const Tok& at = tokens_[repair->at];
      const SourceRange place = repair->closes ? SourceRange{file_, at.end, at.end} : rangeOf(at);
      report<diag::BracketRestored>(spanning(rangeOf(tokens_[i]), rangeOf(tokens_[end - 1])),
                                    repair->closes ? "close the bracket" : "take the bracket out",
                                    {{place, repair->closes ? "]" : ""}}, opened, closed);
      if (repair->closes)
        insert(repair->at + 1, {Lexer::RBRACKET, at.end, at.end, "]"});
      else
        erase(repair->at);
      return;
    }
  }

  std::vector<Tok>& tokens_;
  FileId file_;
  std::string_view source_;
  const UsesVariable& uses_;
  std::vector<Diagnostic> found_;
};

} // namespace

std::vector<Diagnostic> repairListing(std::vector<Tok>& tokens, FileId file, std::string_view source,
                                      const UsesVariable& uses) {
  return Repairer(tokens, file, source, uses).run();
}

} // namespace dotek::frontend::macrob
