#include "frontend/macrob/Scan.h"

#include "support/Ascii.h"
#include "support/Decimal.h"

namespace dotek::frontend::macrob {
namespace {

// A longer block goes to the grammar, where the limits are.
constexpr std::size_t kMostWords = 200;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

class Scanner {
public:
  Scanner(std::string_view text, SourceRange range) : text_(text), range_(range) {}

  std::optional<Block> run() {
    Block block;
    block.range = range_;
    if (!prefix(block)) return std::nullopt;
    skip();
    if (here() == '#') {
      std::optional<nc::Assignment> one = copy();
      if (!one) return std::nullopt;
      block.body = std::move(*one);
      return block;
    }
    Words words;
    while (true) {
      skip();
      if (at_ == text_.size()) break;
      std::optional<nc::Word> one = word();
      // N in the middle of a block is rare: the grammar reads it.
      if (!one || words.words.size() == kMostWords) return std::nullopt;
      words.words.push_back(std::move(*one));
    }
    if (!words.words.empty()) block.body = std::move(words);
    return block;
  }

private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  SourceRange range(std::size_t begin) const {
    return {range_.file, range_.begin + static_cast<std::uint32_t>(begin),
            range_.begin + static_cast<std::uint32_t>(at_)};
  }
  // Blanks and comments.
  void skip() {
    while (at_ < text_.size()) {
      if (isBlank(text_[at_]))
        ++at_;
      else if (text_[at_] == '(')
        at_ = std::min(text_.find(')', at_), text_.size() - 1) + 1;
      else
        break;
    }
  }
  void digits() {
    while (isDigit(here()))
      ++at_;
  }
  // Blanks inside a number: the grammar reads them.
  bool endsNumber() {
    skip();
    return !isDigit(here()) && here() != '.';
  }

  bool prefix(Block& block) {
    skip();
    if (here() == '/') {
      const std::size_t begin = at_++;
      BlockDelete mark;
      skip();
      if (isDigit(here())) {
        if (here() == '0') return false;
        mark.number = static_cast<std::uint32_t>(here() - '0');
        ++at_;
      }
      mark.range = range(begin);
      if (!mark.number) mark.range.end = mark.range.begin + 1;
      if (!endsNumber()) return false;
      block.blockDelete = mark;
    }
    if (here() != 'N') return true;
    const std::size_t begin = at_++;
    skip();
    const std::size_t number = at_;
    digits();
    if (at_ == number || at_ - number > 15) return false;
    SequenceNumber sequence;
    sequence.digits = text_.substr(number, at_ - number);
    sequence.value = std::stoull(sequence.digits);
    sequence.range = range(begin);
    if (!endsNumber()) return false;
    block.sequenceNumber = std::move(sequence);
    return true;
  }

  ExpressionPtr expression(std::size_t begin, decltype(Expression::node) node) const {
    auto out = std::make_unique<Expression>();
    out->range = range(begin);
    out->node = std::move(node);
    return out;
  }
  // Digits; with `point` they may hold one. nullptr: something else is there.
  ExpressionPtr number(bool point) {
    const std::size_t begin = at_;
    digits();
    const bool hasPoint = point && here() == '.';
    if (hasPoint) {
      ++at_;
      digits();
    }
    const std::string_view spelling = text_.substr(begin, at_ - begin);
    if (spelling.empty() || spelling == ".") return nullptr;
    const std::optional<double> value = parseNumber(spelling);
    if (!value) return nullptr;
    ExpressionPtr out = expression(begin, nc::Number{std::string(spelling), *value, hasPoint});
    return endsNumber() ? std::move(out) : nullptr;
  }
  // #n without a point and brackets.
  ExpressionPtr variable() {
    const std::size_t begin = at_++;
    skip();
    const std::size_t digitsBegin = at_;
    ExpressionPtr which = number(false);
    if (which == nullptr) return nullptr;
    const std::size_t behind = at_;
    at_ = digitsBegin + std::get<nc::Number>(which->node).digits.size();
    nc::VariableRef reference;
    reference.number = std::move(which);
    ExpressionPtr out = expression(begin, std::move(reference));
    at_ = behind;
    return out;
  }
  // `#550=#138` or `#550=1.5`, the whole block; all else is for the grammar.
  std::optional<nc::Assignment> copy() {
    const std::size_t begin = at_;
    ExpressionPtr target = variable();
    if (target == nullptr || here() != '=') return std::nullopt;
    ++at_;
    skip();
    ExpressionPtr value;
    if (here() == '#')
      value = variable();
    else if (isDigit(here()) || here() == '.')
      value = number(true);
    if (value == nullptr || at_ != text_.size()) return std::nullopt;
    nc::Assignment out;
    out.variable = std::move(std::get<nc::VariableRef>(target->node).number);
    const std::uint32_t end = value->range.end;
    out.value = std::move(value);
    out.range = range(begin);
    out.range.end = end;
    return out;
  }

  std::optional<nc::Word> word() {
    const char letter = here();
    if (letter < 'A' || letter > 'Z' || letter == 'N' || letter == 'O') return std::nullopt;
    const std::size_t begin = at_++;
    skip();
    std::optional<std::size_t> sign;
    bool minus = false;
    if (here() == '-' || here() == '+') {
      minus = here() == '-';
      sign = at_++;
      skip();
    }
    const std::size_t number = at_;
    digits();
    bool point = false;
    if (here() == '.') {
      point = true;
      ++at_;
      digits();
    }
    const std::string_view spelling = text_.substr(number, at_ - number);
    if (spelling.empty() || spelling == ".") return std::nullopt;
    const std::optional<double> value = parseNumber(spelling);
    if (!value) return std::nullopt;
    auto expression = std::make_unique<Expression>();
    expression->range = range(number);
    expression->node = nc::Number{std::string(spelling), *value, point};
    if (minus) {
      auto negated = std::make_unique<Expression>();
      negated->range = range(*sign);
      negated->node = nc::Negated{std::move(expression)};
      expression = std::move(negated);
    }
    nc::Word out;
    out.address = letter;
    out.range = range(begin);
    out.value = std::move(expression);
    if (!endsNumber()) return std::nullopt;
    return out;
  }

  std::string_view text_;
  SourceRange range_;
  std::size_t at_ = 0;
};

} // namespace

std::optional<Block> scanBlock(std::string_view text, SourceRange range) {
  return Scanner(text, range).run();
}

} // namespace dotek::frontend::macrob
