#include "frontend/macrob/Listing.h"
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
  Repairer(std::vector<Tok>& tokens, FileId file, const UsesVariable& uses)
      : tokens_(tokens), file_(file), uses_(uses) {}

  std::vector<Diagnostic> run() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      starForHash(i);
      pointedVariable(i);
      strayIf(i);
    }
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

  std::vector<Tok>& tokens_;
  FileId file_;
  const UsesVariable& uses_;
  std::vector<Diagnostic> found_;
};

} // namespace

std::vector<Diagnostic> repairListing(std::vector<Tok>& tokens, FileId file, const UsesVariable& uses) {
  return Repairer(tokens, file, uses).run();
}

} // namespace dotek::frontend::macrob
