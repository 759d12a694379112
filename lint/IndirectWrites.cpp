#include "lint/IndirectWrites.h"

#include "ir/Walk.h"
#include "lint/Probing.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dotek::lint {
namespace {

constexpr std::uint32_t kFirstSystem = 1000;
// Locals, common variables, those that are kept: a table begins and ends in one of them.
constexpr NumberRange kKinds[] = {{1, 99}, {100, 499}, {500, 999}};

const ir::ExpressionPtr& bare(const ir::ExpressionPtr& value) {
  const auto* unary = value ? std::get_if<ir::Unary>(&value->node) : nullptr;
  return unary != nullptr && unary->op == ir::UnaryOp::NullAsZero ? bare(unary->operand) : value;
}

// The number that the value adds to this variable; nothing: it is something else.
std::optional<double> stepOf(const ir::ExpressionPtr& value, std::uint32_t variable) {
  const auto* sum = value ? std::get_if<ir::Binary>(&value->node) : nullptr;
  if (sum == nullptr || (sum->op != ir::BinaryOp::Add && sum->op != ir::BinaryOp::Subtract))
    return std::nullopt;
  const double* step = ir::constantValue(sum->right);
  if (step != nullptr && variableNumber(*bare(sum->left)) == variable)
    return sum->op == ir::BinaryOp::Add ? *step : -*step;
  step = ir::constantValue(sum->left);
  if (step != nullptr && sum->op == ir::BinaryOp::Add && variableNumber(*bare(sum->right)) == variable)
    return *step;
  return std::nullopt;
}

void eachComparison(const ir::ConditionPtr& condition, const auto& visit) {
  if (!condition) return;
  if (const auto* one = std::get_if<ir::Not>(&condition->node)) eachComparison(one->inner, visit);
  if (const auto* both = std::get_if<ir::Junction>(&condition->node)) {
    eachComparison(both->left, visit);
    eachComparison(both->right, visit);
  }
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node)) visit(*comparison);
}

} // namespace

// A counter is set to numbers and goes up by numbers; a comparison with a number bounds it.
IndirectWrites::IndirectWrites(const ir::Program& program) {
  struct Counter {
    std::optional<double> low, high, limit;
    double step = 0;
    bool other = false; // set to something else, or counted down
  };
  std::map<std::uint32_t, Counter> all;
  bool any = false;
  std::set<std::uint32_t> more;
  for (const ir::ProgramStatement& statement : program.body) {
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
      const auto number = storedNumber(statement);
      if (!number) {
        const auto first = ir::firstNumber(store->number);
        any = any || !first || *first < kKinds[1].first;
        continue;
      }
      if (!once_.emplace(*number, store->value).second) more.insert(*number);
      Counter& one = all[*number];
      if (const double* value = ir::constantValue(store->value)) {
        one.low = std::min(one.low.value_or(*value), *value);
        one.high = std::max(one.high.value_or(*value), *value);
      } else if (const auto step = stepOf(store->value, *number); step && *step > 0)
        one.step = std::max(one.step, *step);
      else
        one.other = true;
    }
    if (const ir::ConditionPtr* condition = ir::conditionOf(statement); condition != nullptr)
      eachComparison(*condition, [&](const ir::Comparison& comparison) {
        for (const auto& [side, bound] :
             {std::pair{comparison.left, comparison.right}, std::pair{comparison.right, comparison.left}}) {
          const double* value = ir::constantValue(bound);
          const auto number = side ? variableNumber(*bare(side)) : std::nullopt;
          if (value == nullptr || !number) continue;
          Counter& one = all[*number];
          one.limit = std::max(one.limit.value_or(*value), *value);
        }
      });
  }
  for (const std::uint32_t number : more)
    once_.erase(number);
  if (any) return; // may set a counter
  for (const auto& [number, one] : all)
    if (one.low && !one.other && (one.step == 0 || one.limit))
      counters_.emplace(
          number, Bounds{*one.low, one.step == 0 ? *one.high : std::max(*one.high, *one.limit) + one.step});
}

std::optional<IndirectWrites::Bounds> IndirectWrites::bounds(const ir::ExpressionPtr& given) const {
  const ir::ExpressionPtr& value = bare(given);
  if (!value) return std::nullopt;
  if (const double* number = ir::constantValue(value)) return Bounds{*number, *number};
  if (const auto number = variableNumber(*value)) {
    const auto found = counters_.find(*number);
    return found == counters_.end() ? std::nullopt : std::optional(found->second);
  }
  const auto* binary = std::get_if<ir::Binary>(&value->node);
  if (binary == nullptr) return std::nullopt;
  const auto left = bounds(binary->left), right = bounds(binary->right);
  if (!left || !right) return std::nullopt;
  if (binary->op == ir::BinaryOp::Add) return Bounds{left->low + right->low, left->high + right->high};
  if (binary->op == ir::BinaryOp::Subtract) return Bounds{left->low - right->high, left->high - right->low};
  if (binary->op != ir::BinaryOp::Multiply) return std::nullopt;
  const auto [low, high] = std::minmax(
      {left->low * right->low, left->low * right->high, left->high * right->low, left->high * right->high});
  return Bounds{low, high};
}

std::optional<std::uint32_t> IndirectWrites::single(const ir::ExpressionPtr& given) const {
  ir::ExpressionPtr number = bare(given);
  constexpr int kMostDepth = 8;
  for (int depth = 0; number && depth < kMostDepth; ++depth) {
    const auto known = bounds(number);
    if (known && known->low == known->high && known->low >= 1 && known->low < 1e6)
      return static_cast<std::uint32_t>(std::lround(known->low));
    const auto variable = variableNumber(*number);
    const auto once = variable ? once_.find(*variable) : once_.end();
    if (known || once == once_.end()) return std::nullopt;
    number = bare(once->second);
  }
  return std::nullopt;
}

std::optional<std::uint32_t> IndirectWrites::firstNumber(const ir::ExpressionPtr& number) const {
  return firstNumber(number, 0);
}

std::optional<std::uint32_t> IndirectWrites::firstNumber(const ir::ExpressionPtr& given, int depth) const {
  constexpr int kMostDepth = 8;
  const ir::ExpressionPtr& number = bare(given);
  if (!number || depth > kMostDepth) return std::nullopt;
  if (const auto first = ir::firstNumber(number)) return first;
  if (const auto variable = variableNumber(*number)) {
    const auto once = once_.find(*variable);
    return once == once_.end() ? std::nullopt : firstNumber(once->second, depth + 1);
  }
  const auto* sum = std::get_if<ir::Binary>(&number->node);
  if (sum == nullptr || sum->op != ir::BinaryOp::Add) return std::nullopt;
  for (const ir::ExpressionPtr& side : {sum->left, sum->right}) {
    if (const auto one = single(side)) return one;
    if (const auto first = firstNumber(side, depth + 1)) return first;
  }
  return std::nullopt;
}

std::optional<NumberRange> IndirectWrites::range(const ir::ExpressionPtr& number) const {
  const auto known = bounds(number);
  if (known && known->low >= 0 && known->high < 1e6)
    return NumberRange{static_cast<std::uint32_t>(std::floor(known->low)),
                       static_cast<std::uint32_t>(std::ceil(known->high))};
  // What is added is an index: it stays among the variables of the base's kind.
  const auto first = ir::firstNumber(number);
  if (!first || *first == 0) return std::nullopt;
  if (*first >= kFirstSystem) return NumberRange{*first, UINT32_MAX};
  for (const NumberRange& kind : kKinds)
    if (kind.contains(*first)) return kind;
  return std::nullopt;
}

} // namespace dotek::lint
