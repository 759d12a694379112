// Why a block cannot be read, in the words of the control's manual.
#include "frontend/macrob/Misprints.h"
#include "support/messages/Common.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace dotek::frontend::macrob {

using Lexer = grammar::MacroBLexer;

namespace {

bool isStatementWord(std::size_t type) {
  switch (type) {
  case Lexer::KW_IF:
  case Lexer::KW_GOTO:
  case Lexer::KW_WHILE:
  case Lexer::KW_DO:
  case Lexer::KW_END:
  case Lexer::PRINT:
  case Lexer::PORT:
  case Lexer::KW_SETVN: return true;
  default: return false;
  }
}

bool endsOperand(std::size_t type) {
  return type == Lexer::NUMBER || type == Lexer::RBRACKET;
}
bool beginsOperand(std::size_t type) {
  return type == Lexer::NUMBER || type == Lexer::HASH || type == Lexer::FUNCTION || type == Lexer::LBRACKET;
}
bool isBinary(std::size_t type) {
  return type == Lexer::STAR || type == Lexer::SLASH || type == Lexer::KW_AND || type == Lexer::KW_OR ||
         type == Lexer::KW_XOR || type == Lexer::KW_MOD || type == Lexer::RELATION;
}

class Explainer {
public:
  Explainer(const std::vector<Tok>& tokens, std::size_t at, FileId file, std::string_view source,
            std::uint32_t end)
      : tokens_(tokens), at_(at), file_(file), source_(source), end_(end) {}

  Diagnostic run() {
    if (tokens_.empty()) return syntax(here(), "the block cannot be read");
    if (auto odd = oddCharacter()) return *odd;
    if (auto text = plainText()) return *text;
    if (auto both = twoKinds()) return *both;
    if (auto brackets = unbalanced()) return *brackets;
    return byToken();
  }

private:
  std::size_t type(std::size_t i) const { return i < tokens_.size() ? tokens_[i].type : antlr4::Token::EOF; }
  SourceRange rangeOf(const Tok& tok) const { return {file_, tok.begin, tok.end}; }
  SourceRange here() const {
    if (at_ < tokens_.size()) return rangeOf(tokens_[at_]);
    return tokens_.empty() ? SourceRange{file_, end_, end_} : rangeOf(tokens_.back());
  }
  std::string written(SourceRange range) const {
    return std::string(source_.substr(range.begin, range.end - range.begin));
  }
  static Diagnostic syntax(SourceRange range, std::string message) {
    return makeDiagnostic<diag::SyntaxError>(range, message);
  }
  std::size_t find(std::size_t wanted, std::size_t from = 0) const {
    for (std::size_t i = from; i < tokens_.size(); ++i)
      if (type(i) == wanted) return i;
    return tokens_.size();
  }
  bool has(std::size_t wanted) const { return find(wanted) < tokens_.size(); }
  // After `/n` and `Nn`.
  std::size_t bodyBegin() const {
    std::size_t i = 0;
    if (type(i) == Lexer::SLASH) i += type(i + 1) == Lexer::NUMBER ? 2 : 1;
    if (type(i) == Lexer::ADDRESS_N) i += type(i + 1) == Lexer::NUMBER ? 2 : 1;
    return i;
  }

  std::optional<Diagnostic> oddCharacter() const {
    for (const Tok& tok : tokens_) {
      if (tok.type != Lexer::WIDE_CHARACTER && tok.type != Lexer::ANY) continue;
      if (plainLetters()) return std::nullopt;
      const SourceRange range = rangeOf(tok);
      const std::string text = written(range);
      if (text == ")") return syntax(range, "the `)` closes no comment; comments do not nest");
      const auto byte = static_cast<unsigned char>(text.front());
      if (text.size() == 1 && (byte < 0x20 || byte > 0x7E))
        return makeDiagnostic<diag::UnexpectedCharacter>(range, fmt::format("with code {}", int{byte}));
      if (text == "\xC2\xA0")
        return makeDiagnostic<diag::UnexpectedCharacter>(range,
                                                         "no-break space (a copy from a web page or a PDF)");
      return makeDiagnostic<diag::UnexpectedCharacter>(range, fmt::format("`{}`", text));
    }
    return std::nullopt;
  }

  bool plainLetters() const {
    int letters = 0;
    bool small = false;
    for (const Tok& tok : tokens_) {
      if (tok.type == Lexer::NUMBER || tok.type == Lexer::HASH || tok.type == Lexer::LBRACKET ||
          tok.type == Lexer::EQUALS || tok.type == Lexer::PRINT_TEXT)
        return false;
      for (const char c : written(rangeOf(tok))) {
        if (std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) > 127)
          ++letters;
        small = small || std::islower(static_cast<unsigned char>(c)) != 0;
      }
    }
    return letters >= 4 || small;
  }

  std::optional<Diagnostic> plainText() const {
    if (!plainLetters() || isStatementWord(type(bodyBegin()))) return std::nullopt;
    return makeDiagnostic<diag::TextWithoutBrackets>(
        spanning(rangeOf(tokens_.front()), rangeOf(tokens_.back())));
  }

  // An NC statement and a macro statement in one block.
  std::optional<Diagnostic> twoKinds() const {
    const std::size_t begin = bodyBegin();
    if (at_ >= tokens_.size() || at_ == begin) return std::nullopt;
    const bool words = type(begin) == Lexer::ADDRESS;
    const bool balanced = bracketDepth(at_) == 0 && endsOperand(type(at_ - 1));
    if (!balanced) return std::nullopt;
    if (words && type(at_) == Lexer::HASH && has(Lexer::EQUALS))
      return makeDiagnostic<diag::NcAndMacroStatement>(here());
    if (words && isStatementWord(type(at_))) return makeDiagnostic<diag::NcAndMacroStatement>(here());
    const bool word = type(at_) == Lexer::ADDRESS || type(at_) == Lexer::ADDRESS_N;
    if (type(begin) == Lexer::HASH && type(at_) == Lexer::KW_GOTO && has(Lexer::EQUALS))
      return syntax(here(),
                    "a block takes one statement of a macro; the control stops with an alarm; write `GOTO` "
                    "into a block of its own");
    if (!words && word && type(begin) != Lexer::KW_IF && beginsValue(at_ + 1))
      return makeDiagnostic<diag::NcAndMacroStatement>(here());
    return std::nullopt;
  }
  bool beginsValue(std::size_t i) const {
    return type(i) == Lexer::NUMBER || type(i) == Lexer::HASH || type(i) == Lexer::LBRACKET ||
           type(i) == Lexer::MINUS || type(i) == Lexer::PLUS;
  }
  int bracketDepth(std::size_t end) const {
    int depth = 0;
    for (std::size_t i = 0; i < end; ++i)
      depth += type(i) == Lexer::LBRACKET ? 1 : type(i) == Lexer::RBRACKET ? -1 : 0;
    return depth;
  }

  std::optional<Diagnostic> unbalanced() const {
    std::vector<std::size_t> open;
    const auto count = [&](std::size_t wanted) {
      return std::count_if(tokens_.begin(), tokens_.end(), [&](const Tok& t) { return t.type == wanted; });
    };
    const auto opening = count(Lexer::LBRACKET);
    const auto closing = count(Lexer::RBRACKET);
    if (opening == closing) return std::nullopt;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (type(i) == Lexer::LBRACKET) open.push_back(i);
      if (type(i) != Lexer::RBRACKET) continue;
      if (open.empty())
        return makeDiagnostic<diag::BracketsDoNotMatch>(rangeOf(tokens_[i]), opening, closing);
      open.pop_back();
    }
    const std::size_t first = open.empty() ? 0 : open.front();
    return makeDiagnostic<diag::BracketsDoNotMatch>(rangeOf(tokens_[first]), opening, closing);
  }

  Diagnostic byToken() const {
    const std::size_t begin = bodyBegin();
    const std::size_t before = at_ > 0 ? type(at_ - 1) : antlr4::Token::EOF;
    const std::string text = at_ < tokens_.size() ? written(here()) : "";
    if (type(at_) == Lexer::EQUALS) return equals(begin);
    if (before == Lexer::HASH && type(at_) == Lexer::HASH)
      return syntax(here(), "`##` is no variable; write the number in brackets, `#[#1]`");
    if (before == Lexer::HASH) return syntax(rangeOf(tokens_[at_ - 1]), "no number follows the `#`");
    if (type(at_) == Lexer::ADDRESS_O)
      return syntax(here(), "the letter O is here; a block holds no address O, and a zero is a digit");
    const bool addressBefore = before == Lexer::ADDRESS || before == Lexer::ADDRESS_N;
    if (addressBefore && type(at_) == Lexer::FUNCTION)
      return syntax(here(),
                    fmt::format("the value of `{}` is a calculation; put it into brackets, `{}[{}[..]]`",
                                tokens_[at_ - 1].text, tokens_[at_ - 1].text, tokens_[at_].text));
    const bool sign = before == Lexer::MINUS || before == Lexer::PLUS;
    if (sign && type(at_) == Lexer::FUNCTION && at_ >= 2 &&
        (type(at_ - 2) == Lexer::ADDRESS || type(at_ - 2) == Lexer::ADDRESS_N))
      return syntax(here(),
                    fmt::format("the value of `{0}` is a calculation; put it into brackets with its sign, "
                                "`{0}[{1}{2}[..]]`",
                                tokens_[at_ - 2].text, tokens_[at_ - 1].text, tokens_[at_].text));
    if (addressBefore)
      return syntax(rangeOf(tokens_[at_ - 1]),
                    fmt::format("no value follows the address `{}`", tokens_[at_ - 1].text));
    if (type(at_) == Lexer::NUMBER && (at_ == begin || endsOperand(before)) && bracketDepth(at_) == 0)
      return makeDiagnostic<diag::NumberWithoutAddress>(here(), text);
    if (endsOperand(before) && beginsOperand(type(at_)))
      return makeDiagnostic<diag::MissingOperator>(here(), written(rangeOf(tokens_[at_ - 1])), text);
    if (isBinary(type(at_)) && (isBinary(before) || before == Lexer::PLUS || before == Lexer::MINUS ||
                                before == Lexer::LBRACKET || before == Lexer::EQUALS))
      return syntax(here(), fmt::format("no value is before `{}`", text));
    if (type(at_) == antlr4::Token::EOF || type(at_) == Lexer::RBRACKET) {
      if (isBinary(before) || before == Lexer::PLUS || before == Lexer::MINUS)
        return syntax(rangeOf(tokens_[at_ - 1]),
                      fmt::format("no value follows `{}`", written(rangeOf(tokens_[at_ - 1]))));
      if (before == Lexer::LBRACKET) return syntax(rangeOf(tokens_[at_ - 1]), "nothing is in the brackets");
    }
    return byStatement(begin, text);
  }

  Diagnostic equals(std::size_t begin) const {
    if (type(begin) == Lexer::KW_IF || type(begin) == Lexer::KW_WHILE)
      if (bracketDepth(at_) > 0) return syntax(here(), "a condition compares with a word; write `EQ`");
    if (find(Lexer::EQUALS) < at_) return makeDiagnostic<diag::SecondEquals>(here());
    if (type(begin) == Lexer::ADDRESS) {
      const SourceRange target = spanning(rangeOf(tokens_[begin]), rangeOf(tokens_[at_ - 1]));
      return makeDiagnostic<diag::AssignmentTarget>(target, written(target));
    }
    return syntax(here(), "only a variable takes a value; write `#1=` with its number");
  }

  // `(A (B) C)`: the rest of what was meant as one comment.
  bool followsNestedComment() const {
    const std::size_t begin = here().begin;
    std::size_t before = begin;
    while (before > 0 && (source_[before - 1] == ' ' || source_[before - 1] == '\t'))
      --before;
    if (before == 0 || source_[before - 1] != ')') return false;
    const std::size_t close = source_.find_first_of(")(\r\n", begin);
    return close != std::string_view::npos && source_[close] == ')';
  }

  Diagnostic byStatement(std::size_t begin, const std::string& text) const {
    switch (type(begin)) {
    case Lexer::KW_IF:
      if (at_ == begin + 1) return syntax(here(), "the condition of IF is in brackets, `IF[#1EQ2]`");
      if (followsNestedComment())
        return syntax(here(), "a comment ends at its first `)`, so this is no part of it; the control stops "
                              "with an alarm; take the inner brackets out");
      return syntax(here(),
                    "after its condition, IF takes `GOTO` with a number, or `THEN` with one macro statement");
    case Lexer::KW_WHILE:
      if (at_ == begin + 1) return syntax(here(), "the condition of WHILE is in brackets, `WHILE[#1LE2]DO1`");
      return syntax(here(), "after its condition, WHILE takes `DO` with the number of its loop");
    case Lexer::KW_GOTO:
      return syntax(here(), "GOTO takes the number of a block, a variable or an expression in brackets");
    case Lexer::KW_DO:
    case Lexer::KW_END: return syntax(here(), "DO and END take one number, 1 to 3, and nothing else");
    case Lexer::PRINT:
      return syntax(here(), "what is printed is in brackets, `DPRNT[X#100[53]]`, alone in its block");
    case Lexer::PORT: return syntax(here(), "POPEN and PCLOS are alone in their block");
    case Lexer::KW_SETVN: return syntax(here(), "SETVN takes a variable and names, `SETVN 510[ONE,TWO]`");
    case Lexer::KW_THEN: return syntax(here(), "THEN follows the condition of an IF");
    default: break;
    }
    return syntax(here(),
                  text.empty() ? "the block ends too early" : fmt::format("`{}` has no meaning here", text));
  }

  const std::vector<Tok>& tokens_;
  std::size_t at_;
  FileId file_;
  std::string_view source_;
  std::uint32_t end_;
};

} // namespace

Diagnostic explainBlock(const std::vector<Tok>& tokens, std::size_t at, FileId file, std::string_view source,
                        std::uint32_t end) {
  return Explainer(tokens, at, file, source, end).run();
}

} // namespace dotek::frontend::macrob
