#include "frontend/macrob/Brackets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace dotek::frontend::macrob {

using Lexer = grammar::MacroBLexer;

namespace {

constexpr std::size_t kLongest = 60; // tokens that are tried
constexpr int kDeepest = 8;

// A number for each operand, the same for the same text: values that agree for two seeds are the same
// formula.
double standIn(const std::string& text, std::size_t seed) {
  const std::size_t hash = std::hash<std::string>()(text + std::to_string(seed));
  return 1 + static_cast<double>(hash % 9973) / 997;
}

// A value with `+`, `-`, `*`, `/`, variables, brackets and functions; nothing else is compared.
class Value {
public:
  Value(const std::vector<Tok>& tokens, std::size_t seed) : tokens_(tokens), seed_(seed) {}

  // nullopt: it is none.
  std::optional<double> of(bool word) {
    const auto out = word ? signedOperand() : sum();
    return out && at_ == tokens_.size() ? out : std::nullopt;
  }

private:
  std::size_t type() const { return typeAt(tokens_, at_); }
  bool take(std::size_t what) {
    if (type() != what) return false;
    ++at_;
    return true;
  }

  std::optional<double> sum() {
    if (++depth_ > kDeepest) return std::nullopt;
    auto out = product();
    while (out && (type() == Lexer::PLUS || type() == Lexer::MINUS)) {
      const bool minus = type() == Lexer::MINUS;
      ++at_;
      const auto next = product();
      if (!next) return std::nullopt;
      *out += minus ? -*next : *next;
    }
    --depth_;
    return out;
  }
  std::optional<double> product() {
    auto out = signedOperand();
    while (out && (type() == Lexer::STAR || type() == Lexer::SLASH)) {
      const bool divide = type() == Lexer::SLASH;
      ++at_;
      const auto next = signedOperand();
      if (!next) return std::nullopt;
      out = divide ? *out / *next : *out * *next;
    }
    return out;
  }
  std::optional<double> signedOperand() {
    const bool minus = take(Lexer::MINUS);
    if (!minus) take(Lexer::PLUS);
    const auto out = operand();
    return out && minus ? std::optional(-*out) : out;
  }
  std::optional<double> operand() {
    if (type() == Lexer::NUMBER) return standIn(tokens_[at_++].text, seed_);
    if (take(Lexer::HASH)) {
      const auto number = type() == Lexer::HASH ? std::nullopt : operand();
      return number ? std::optional(standIn("#" + std::to_string(*number), seed_)) : std::nullopt;
    }
    if (type() == Lexer::FUNCTION) {
      const std::string& name = tokens_[at_++].text;
      if (type() != Lexer::LBRACKET) return std::nullopt;
      const auto in = operand();
      return in ? std::optional(std::sin(*in * standIn(name, seed_)) + 2) : std::nullopt;
    }
    if (!take(Lexer::LBRACKET)) return std::nullopt;
    const auto out = sum();
    return out && take(Lexer::RBRACKET) ? out : std::nullopt;
  }

  const std::vector<Tok>& tokens_;
  std::size_t seed_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

struct Pair {
  double first = 0, second = 0;
};
std::optional<Pair> valuesOf(const std::vector<Tok>& tokens, bool word) {
  const auto one = Value(tokens, 1).of(word), other = Value(tokens, 2).of(word);
  return one && other ? std::optional(Pair{*one, *other}) : std::nullopt;
}
bool same(double a, double b) {
  return std::abs(a - b) <= 1e-9 * (std::abs(a) + std::abs(b));
}

} // namespace

std::optional<BracketRepair> bracketRepair(const std::vector<Tok>& tokens, std::size_t first, std::size_t end,
                                           bool ofWord) {
  if (end <= first || end - first > kLongest) return std::nullopt;
  const std::vector<Tok> span(tokens.begin() + static_cast<std::ptrdiff_t>(first),
                              tokens.begin() + static_cast<std::ptrdiff_t>(end));
  const auto count = [&](std::size_t type) {
    return std::count_if(span.begin(), span.end(), [&](const Tok& one) { return one.type == type; });
  };
  const auto missing = count(Lexer::LBRACKET) - count(Lexer::RBRACKET);
  if (missing != 1 && missing != -1) return std::nullopt;
  std::optional<Pair> value;
  std::optional<BracketRepair> out;
  bool agree = true;
  const auto consider = [&](std::vector<Tok> with, std::optional<BracketRepair> repair) {
    const auto is = valuesOf(with, ofWord);
    if (!is) return;
    agree = agree && (!value || (same(value->first, is->first) && same(value->second, is->second)));
    value = is;
    if (repair) out = repair; // the last place
  };
  for (std::size_t i = 0; i < span.size(); ++i) {
    const bool closing = span[i].type == Lexer::RBRACKET;
    std::vector<Tok> with = span;
    // One is taken out: of those that are too many, or the partner of the lost one.
    if (missing == 1 ? span[i].type == Lexer::LBRACKET : closing) {
      with.erase(with.begin() + static_cast<std::ptrdiff_t>(i));
      consider(with, missing == 1 ? std::nullopt : std::optional(BracketRepair{i, false}));
      with = span;
    }
    // One is put in. `#[1+#2]` with the number of a local is written by nobody.
    const bool local = missing == -1 && i > 0 && span[i - 1].type == Lexer::HASH && span[i].text.size() <= 2;
    if (local) continue;
    const Tok bracket{missing == 1 ? std::size_t(Lexer::RBRACKET) : std::size_t(Lexer::LBRACKET), 0, 0, ""};
    with.insert(with.begin() + static_cast<std::ptrdiff_t>(missing == 1 ? i + 1 : i), bracket);
    consider(with, missing == 1 ? std::optional(BracketRepair{i, true}) : std::nullopt);
  }
  if (!agree || !out) return std::nullopt;
  out->at += first;
  return out;
}

} // namespace dotek::frontend::macrob
