// Macro statements that steer a program: IF, GOTO, WHILE, DO, END.
#include "frontend/nc/BlockParser.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace dotek::frontend::nc {
namespace {

constexpr std::size_t kMostDigits = 8;
constexpr std::array<std::string_view, 6> kRelations = {"EQ", "NE", "GT", "LT", "GE", "LE"};

// What sums and products of numbers come to; nothing: it counts from something else.
std::optional<double> constantOf(const Expression& expression) {
  if (const auto* number = std::get_if<Number>(&expression.node)) return number->value;
  if (const auto* negated = std::get_if<Negated>(&expression.node)) {
    const auto value = constantOf(*negated->operand);
    return value ? std::optional(-*value) : std::nullopt;
  }
  const auto* operation = std::get_if<Operation>(&expression.node);
  if (operation == nullptr) return std::nullopt;
  const auto left = constantOf(*operation->left), right = constantOf(*operation->right);
  if (!left || !right) return std::nullopt;
  if (operation->op == "+") return *left + *right;
  if (operation->op == "-") return *left - *right;
  return operation->op == "*" ? std::optional(*left * *right) : std::nullopt;
}

} // namespace

bool BlockParser::take(std::string_view word) {
  in_.skipBlanks();
  if (!in_.startsWith(word)) return false;
  in_.skip(word.size());
  return true;
}

bool BlockParser::statement(Block& block) {
  const std::size_t begin = in_.position();
  Statement out;
  const bool conditional = take("IF");
  if (conditional || take("WHILE")) {
    out.condition = conditionHere();
    if (!out.condition) return false;
  }
  if (conditional && take("THEN") && !in_.startsWith("GOTO")) {
    in_.skipBlanks();
    out.kind = Statement::Kind::IfThen;
    if (in_.peek() != '#' && !in_.startsWith("GOTO"))
      return syntax(in_.here(), "`THEN` takes an assignment after it: `THEN #100=1`");
  }
  in_.skipBlanks();
  if (out.kind == Statement::Kind::IfThen && in_.peek() == '#') {
    if (!assignment(block)) return false;
  } else if ((conditional || !out.condition) && take("GOTO")) {
    out.kind = conditional ? Statement::Kind::If : Statement::Kind::GoTo;
    if (!statementNumber("GOTO", out.number)) return false;
  } else if (conditional) {
    return syntax(in_.here(), "`IF[..]` takes `GOTO` or `THEN` after it");
  } else if (take("DO")) {
    out.kind = Statement::Kind::While;
    if (!statementNumber("DO", out.number)) return false;
  } else if (out.condition) {
    return syntax(in_.here(), "`WHILE[..]` takes `DO` after it");
  } else if (take("END")) {
    out.kind = Statement::Kind::End;
    if (!statementNumber("END", out.number)) return false;
  }
  out.range = in_.range(begin, in_.position());
  block.statement = std::move(out);
  return true;
}

bool BlockParser::statementNumber(std::string_view after, std::uint64_t& out) {
  in_.skipBlanks();
  const std::size_t begin = in_.position();
  if (in_.peek() == '[' && after == "GOTO") {
    const ExpressionPtr number = bracketed();
    if (!number) return false;
    const std::optional<double> value = constantOf(*number);
    constexpr double kMost = 99'999'999;
    if (value && *value >= 1 && *value <= kMost && *value == std::trunc(*value)) {
      out = static_cast<std::uint64_t>(*value);
      return true;
    }
    diagnostics_.report<diag::JumpComputed>(in_.range(begin, in_.position()), after);
    return false;
  }
  while (isDigit(in_.peek()))
    in_.skip();
  const std::size_t end = in_.position();
  if (end == begin || in_.peek() == Reader::kHole || in_.peek() == '.') {
    diagnostics_.report<diag::JumpComputed>(in_.range(begin, std::max(end, begin + 1)), after);
    return false;
  }
  if (end - begin > kMostDigits)
    return syntax(in_.range(begin, end), "`{}` takes a number of up to {} digits", after, kMostDigits);
  out = std::stoull(std::string(in_.text(begin, end)));
  return true;
}

// Whether the bracket here holds a comparison, not a number: no number has a relation within it.
bool BlockParser::holdsRelation() const {
  std::size_t depth = 0;
  for (std::size_t at = in_.position(); in_.at(at) != Reader::kEnd; ++at) {
    const char c = in_.at(at);
    if (c == '[') ++depth;
    if (c == ']' && --depth == 0) return false;
    if (!isCapital(c)) continue;
    std::size_t end = at;
    while (isCapital(in_.at(end)))
      ++end;
    const std::string word(in_.text(at, end));
    if (std::any_of(kRelations.begin(), kRelations.end(),
                    [&](std::string_view one) { return word.starts_with(one); }))
      return true;
    at = end - 1;
  }
  return false;
}

ConditionPtr BlockParser::joined(std::initializer_list<std::string_view> operators,
                                 ConditionPtr (BlockParser::*operand)()) {
  ConditionPtr out = (this->*operand)();
  while (out) {
    const std::string_view op = operatorHere(operators);
    if (op.empty()) break;
    if (!count()) return nullptr;
    ConditionPtr right = (this->*operand)();
    if (!right) return nullptr;
    auto both = std::make_unique<Condition>();
    both->range = {out->range.file, out->range.begin, right->range.end};
    both->node = Joined{op == "AND"  ? Joint::And
                        : op == "OR" ? Joint::Or
                                     : Joint::Xor,
                        std::move(out), std::move(right)};
    out = std::move(both);
  }
  return out;
}

ConditionPtr BlockParser::junction() {
  return joined({"OR", "XOR"}, &BlockParser::conjunction);
}

ConditionPtr BlockParser::conjunction() {
  return joined({"AND"}, &BlockParser::conditionHere);
}

ConditionPtr BlockParser::conditionHere() {
  in_.skipBlanks();
  if (in_.peek() != '[') {
    syntax(in_.here(), "a condition is in brackets: `[#100 EQ 1]`");
    return nullptr;
  }
  if (!enter()) return nullptr;
  const std::size_t begin = in_.position();
  in_.skip();
  in_.skipBlanks();
  auto out = std::make_unique<Condition>();
  if (in_.peek() == '[' && holdsRelation()) {
    out = junction();
    if (!out) return nullptr;
  } else {
    Comparison comparison;
    comparison.left = expression();
    if (!comparison.left) return nullptr;
    comparison.relation = operatorHere({"EQ", "NE", "GT", "LT", "GE", "LE"});
    if (comparison.relation.empty()) {
      syntax(in_.here(), "a comparison is missing: EQ, NE, GT, LT, GE or LE");
      return nullptr;
    }
    comparison.right = expression();
    if (!comparison.right) return nullptr;
    out->node = std::move(comparison);
  }
  leave();
  in_.skipBlanks();
  if (in_.peek() != ']') {
    if (in_.peek() == Reader::kEnd)
      syntax(in_.here(), "a `]` is missing");
    else
      unexpected();
    return nullptr;
  }
  in_.skip();
  out->range = in_.range(begin, in_.position());
  return out;
}

} // namespace dotek::frontend::nc
