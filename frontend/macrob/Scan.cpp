#include "frontend/macrob/Scan.h"

#include "frontend/macrob/Keywords.h"
#include "support/Ascii.h"
#include "support/Decimal.h"

#include <algorithm>

namespace dotek::frontend::macrob {
namespace {

// Longer and deeper blocks go to the grammar, where the limits are.
constexpr std::size_t kMostWords = 200;
constexpr std::size_t kMostTokens = 300; // aside from words with numbers
constexpr std::size_t kDeepest = 20;
constexpr std::size_t kLongestRun = 32; // letters

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

class Scanner {
public:
  Scanner(std::string_view text, SourceRange range, const Limits& limits, bool macros)
      : text_(text), range_(range), macros_(macros),
        mostTokens_(std::min<std::size_t>(kMostTokens, limits.lineTokens / 2)),
        deepest_(std::min<std::size_t>(kDeepest, limits.nesting / 2)) {}

  std::optional<Block> run() {
    Block block;
    block.range = range_;
    if (!prefix(block)) return std::nullopt;
    skip();
    if (at_ < text_.size() && !statement(block)) return std::nullopt;
    skip();
    if (at_ < text_.size() || tokens_ > mostTokens_) return std::nullopt;
    return block;
  }

private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  SourceRange range(std::size_t begin) const {
    return {range_.file, range_.begin + static_cast<std::uint32_t>(begin),
            range_.begin + static_cast<std::uint32_t>(end_)};
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
  void advance(std::size_t length) {
    at_ += length;
    end_ = at_;
    ++tokens_;
  }
  bool takeSign(char c) {
    skip();
    if (here() != c) return false;
    advance(1);
    return true;
  }
  void digits() {
    while (isDigit(here()))
      ++at_;
    end_ = at_;
  }
  // Blanks inside a number: the grammar reads them.
  bool endsNumber() {
    end_ = at_;
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
      end_ = at_;
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

  // ---- words and keywords

  // What the letters from here on begin with. nothing: the word has blanks inside, or there are too many
  // letters.
  std::optional<WordMatch> wordHere() {
    if (wordAt_ == at_) return word_;
    wordAt_ = at_;
    word_.reset();
    char letters[kLongestRun];
    std::size_t places[kLongestRun];
    std::size_t count = 0;
    for (std::size_t i = at_; i < text_.size(); ++i) {
      const char c = text_[i];
      if (c == ' ' || c == '\t') continue;
      if (c < 'A' || c > 'Z') {
        if (isLetter(c)) return word_; // small
        break;
      }
      if (count == kLongestRun) return word_;
      letters[count] = c;
      places[count++] = i;
    }
    const WordMatch match = macrob::wordAt({letters, count});
    if (places[match.length - 1] == at_ + match.length - 1) word_ = match;
    return word_;
  }
  bool isLetterHere() const { return here() >= 'A' && here() <= 'Z'; }
  // Goes past a word of this kind, if there is one; "": there is none.
  std::string_view takeWord(WordKind kind) {
    skip();
    if (!isLetterHere()) return {};
    const std::optional<WordMatch> match = wordHere();
    if (!match || match->kind != kind) return {};
    const std::size_t begin = at_;
    advance(match->length);
    return text_.substr(begin, match->length);
  }

  bool statement(Block& block) {
    const std::size_t begin = at_;
    if (here() == '#') {
      std::optional<nc::Assignment> one = assignment();
      // In the print of a program the grammar reads all others.
      const bool copies = one && (std::holds_alternative<nc::Number>(one->value->node) ||
                                  std::holds_alternative<nc::VariableRef>(one->value->node));
      if (!one || (!macros_ && (!copies || hasBracket_))) return false;
      block.body = std::move(*one);
      return true;
    }
    if (!isLetterHere()) return false;
    if (isPlain()) return words(block);
    const std::optional<WordMatch> match = wordHere();
    if (!match || !macros_) return false;
    switch (match->kind) {
    case WordKind::Address: return words(block);
    case WordKind::If: return conditional(block);
    case WordKind::Goto: {
      std::optional<Goto> jump = jumpHere();
      if (jump) block.body = std::move(*jump);
      return jump.has_value();
    }
    case WordKind::While: {
      takeWord(WordKind::While);
      Do loop;
      loop.condition = bracket().condition;
      if (!loop.condition || takeWord(WordKind::Do).empty()) return false;
      return numbered(std::move(loop), begin, block);
    }
    case WordKind::Do: {
      takeWord(WordKind::Do);
      return numbered(Do(), begin, block);
    }
    case WordKind::End: {
      takeWord(WordKind::End);
      return numbered(End(), begin, block);
    }
    default: return false;
    }
  }

  // A DO or an END: its number is what is left.
  template <class Loop> bool numbered(Loop loop, std::size_t begin, Block& block) {
    loop.loop = loopNumber();
    loop.range = range(begin);
    const bool good = loop.loop.has_value();
    block.body = std::move(loop);
    return good;
  }

  // A letter and something of a number after it.
  bool isPlain() const {
    std::size_t next = at_ + 1;
    while (next < text_.size() && isBlank(text_[next]))
      ++next;
    return next < text_.size() &&
           (isDigit(text_[next]) || std::string_view("+-.").find(text_[next]) != std::string_view::npos);
  }

  bool words(Block& block) {
    Words words;
    for (skip(); at_ < text_.size(); skip()) {
      std::optional<nc::Word> one = word();
      // N in the middle of a block is rare: the grammar reads it.
      if (!one || words.words.size() == kMostWords) return false;
      words.words.push_back(std::move(*one));
    }
    block.body = std::move(words);
    return true;
  }

  std::optional<nc::Word> word() {
    const char letter = here();
    if (!isLetterHere() || letter == 'N' || letter == 'O') return std::nullopt;
    const std::size_t begin = at_++;
    nc::Word out;
    out.address = letter;
    out.value = wordValue();
    if (out.value == nullptr) return std::nullopt;
    out.range = range(begin);
    return out;
  }

  // A number, a variable or a bracket, with a sign. nullptr: something else is there.
  ExpressionPtr wordValue() {
    skip();
    std::optional<std::size_t> minus;
    if (here() == '-' || here() == '+') {
      if (here() == '-') minus = at_;
      ++at_;
      skip();
    }
    ExpressionPtr value;
    if (here() == '#' && macros_)
      value = variable();
    else if (here() == '[' && macros_)
      value = bracket().number;
    else
      value = number(true);
    if (value == nullptr || !minus) return value;
    return expression(*minus, nc::Negated{std::move(value)});
  }

  std::optional<Goto> jumpHere() {
    const std::size_t begin = at_;
    if (takeWord(WordKind::Goto).empty()) return std::nullopt;
    Goto out;
    out.target = wordValue();
    if (out.target == nullptr) return std::nullopt;
    out.range = range(begin);
    return out;
  }

  bool conditional(Block& block) {
    const std::size_t begin = at_;
    takeWord(WordKind::If);
    If out;
    out.condition = bracket().condition;
    if (!out.condition) return false;
    out.then = !takeWord(WordKind::Then).empty();
    skip();
    if (out.then && here() == '#') {
      std::optional<nc::Assignment> one = assignment();
      if (!one) return false;
      out.statement = std::move(*one);
    } else {
      std::optional<Goto> jump = jumpHere();
      if (!jump) return false;
      out.statement = std::move(*jump);
    }
    out.range = range(begin);
    block.body = std::move(out);
    return true;
  }

  std::optional<LoopNumber> loopNumber() {
    skip();
    const std::size_t begin = at_;
    digits();
    if (at_ == begin || at_ - begin > 9) return std::nullopt;
    LoopNumber out;
    out.range = range(begin);
    out.digits = text_.substr(begin, at_ - begin);
    out.value = static_cast<std::uint32_t>(std::stoul(out.digits));
    if (!endsNumber()) return std::nullopt;
    return out;
  }

  std::optional<nc::Assignment> assignment() {
    const std::size_t begin = at_;
    ExpressionPtr target = variable();
    if (target == nullptr || !takeSign('=')) return std::nullopt;
    nc::Assignment out;
    out.variable = std::move(std::get<nc::VariableRef>(target->node).number);
    out.value = comparison().number;
    if (out.value == nullptr) return std::nullopt;
    out.range = range(begin);
    return out;
  }

  // ---- expressions, as BuildAst.cpp makes them of the grammar's tree

  // One of them; neither: the grammar has to read it.
  struct Value {
    ExpressionPtr number;
    ConditionPtr condition;
    explicit operator bool() const { return number != nullptr || condition != nullptr; }
    SourceRange range() const { return number != nullptr ? number->range : condition->range; }
  };
  static Value numberValue(ExpressionPtr number) {
    Value out;
    out.number = std::move(number);
    return out;
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
  // #n without a point, #[..].
  ExpressionPtr variable() {
    const std::size_t begin = at_;
    advance(1);
    skip();
    nc::VariableRef reference;
    reference.number = here() == '[' ? bracket().number : number(false);
    if (reference.number == nullptr) return nullptr;
    return expression(begin, std::move(reference));
  }

  Value bracket() {
    skip();
    const std::size_t begin = at_;
    if (++depth_ > deepest_ || !takeSign('[')) return {};
    hasBracket_ = true;
    Value value = comparison();
    if (!value || !takeSign(']')) return {};
    --depth_;
    if (value.number) {
      ++value.number->brackets;
      value.number->range = range(begin);
    } else {
      ++value.condition->brackets;
      value.condition->range = range(begin);
    }
    return value;
  }

  Value comparison() {
    skip();
    const std::size_t begin = at_;
    Value left = sum();
    const std::string_view relation = takeWord(WordKind::Relation);
    if (relation.empty()) return left;
    Value right = sum();
    if (!left.number || !right.number) return {};
    Comparison comparison;
    comparison.op = relation;
    comparison.left = std::move(left.number);
    comparison.right = std::move(right.number);
    Value out;
    out.condition = std::make_unique<Condition>();
    out.condition->range = range(begin);
    out.condition->node = std::move(comparison);
    return out;
  }

  Value joined(Value left, std::string_view op, Value right) {
    if (!left || !right || tokens_ > mostTokens_) return {};
    const SourceRange range{range_.file, left.range().begin, right.range().end};
    if (left.condition && right.condition && (op == "AND" || op == "OR" || op == "XOR")) {
      Value out;
      out.condition = std::make_unique<Condition>();
      out.condition->range = range;
      out.condition->node =
          JoinedConditions{std::string(op), std::move(left.condition), std::move(right.condition)};
      return out;
    }
    if (!left.number || !right.number) return {};
    ExpressionPtr out = std::make_unique<Expression>();
    out->range = range;
    out->node = nc::Operation{std::string(op), std::move(left.number), std::move(right.number)};
    return numberValue(std::move(out));
  }

  // One of two signs or of two words.
  std::string_view takeOperator(std::string_view signs, WordKind first, WordKind second) {
    skip();
    if (at_ < text_.size() && signs.find(text_[at_]) != std::string_view::npos) {
      advance(1);
      return text_.substr(end_ - 1, 1);
    }
    const std::string_view word = takeWord(first);
    return word.empty() ? takeWord(second) : word;
  }

  Value sum() { return chain(&Scanner::product, "+-", WordKind::Or, WordKind::Xor); }
  Value product() { return chain(&Scanner::factor, "*/", WordKind::And, WordKind::Mod); }
  // Operands with operators of one rank between them, from the left.
  Value chain(Value (Scanner::*operand)(), std::string_view signs, WordKind first, WordKind second) {
    Value out = (this->*operand)();
    while (out) {
      const std::string_view op = takeOperator(signs, first, second);
      if (op.empty()) break;
      Value right = (this->*operand)();
      out = joined(std::move(out), op, std::move(right));
    }
    return out;
  }

  Value factor() {
    skip();
    const std::size_t begin = at_;
    switch (here()) {
    case '#': return numberValue(variable());
    case '[': return bracket();
    case '+':
    case '-': {
      if (++depth_ > deepest_) return {};
      const bool minus = here() == '-';
      advance(1);
      Value value = factor();
      --depth_;
      if (!value.number || !minus) return value.number ? std::move(value) : Value();
      return numberValue(expression(begin, nc::Negated{std::move(value.number)}));
    }
    default: break;
    }
    if (!isLetterHere()) {
      ++tokens_;
      return numberValue(number(true));
    }
    nc::FunctionCall call;
    call.name = takeWord(WordKind::Function);
    // Those of two arguments are rare, and `/` may belong to ATAN.
    if (call.name.empty() || call.name == "ATAN" || call.name == "POW") return {};
    skip();
    call.bare = here() == '#';
    ExpressionPtr argument;
    if (call.bare) {
      argument = variable();
    } else {
      if (++depth_ > deepest_ || !takeSign('[')) return {};
      argument = comparison().number;
      if (!takeSign(']')) return {};
      --depth_;
    }
    if (argument == nullptr) return {};
    call.arguments.push_back(std::move(argument));
    return numberValue(expression(begin, std::move(call)));
  }

  std::string_view text_;
  SourceRange range_;
  bool macros_;
  std::size_t mostTokens_, deepest_;
  std::size_t at_ = 0;
  std::size_t end_ = 0; // of the last token
  std::size_t tokens_ = 0, depth_ = 0;
  bool hasBracket_ = false;
  std::size_t wordAt_ = std::string_view::npos; // where `word_` is
  std::optional<WordMatch> word_;
};

} // namespace

std::optional<Block> scanBlock(std::string_view text, SourceRange range, const Limits& limits, bool macros) {
  return Scanner(text, range, limits, macros).run();
}

} // namespace dotek::frontend::macrob
