// Values that the source leaves in variables: results, of the kind of what is left there.
#include "backends/cycle/State.h"
#include "ir/Match.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::backends::cycle {

namespace {

// What is known of all values that one variable gets.
class Values {
public:
  explicit Values(const State& state) : state_(state) {}

  bool isWhole(const ir::ExpressionPtr& value) {
    if (const double* constant = ir::constantValue(value))
      return *constant == std::floor(*constant) && !hasPoint(value);
    const ir::Expression& inner = bare(value);
    if (const auto* use = std::get_if<ir::VariableUse>(&inner.node)) return isWhole(use->variable);
    const auto* binary = std::get_if<ir::Binary>(&inner.node);
    return binary != nullptr &&
           (binary->op == ir::BinaryOp::Add || binary->op == ir::BinaryOp::Subtract ||
            binary->op == ir::BinaryOp::Multiply) &&
           isWhole(binary->left) && isWhole(binary->right);
  }

private:
  // `1.` is a dimension to the control, or may be.
  static bool hasPoint(const ir::ExpressionPtr& value) {
    const auto* constant = std::get_if<ir::Constant>(&value->node);
    return constant != nullptr && constant->digits.find('.') != std::string::npos;
  }
  bool isWhole(ir::VariableId id) {
    const ir::Variable& variable = state_.cycle.variable(id);
    if (variable.kind == ir::Kind::Count) return true;
    if (variable.role != ir::Role::Local || variable.kind != ir::Kind::Number) return false;
    if (!seen_.insert(id).second) return true; // by what gives it its values
    return std::all_of(state_.cycle.body.begin(), state_.cycle.body.end(), [&](const auto& one) {
      const auto* set = std::get_if<ir::Assign>(&one.node);
      return set == nullptr || set->variable != id || isWhole(set->value);
    });
  }

  const State& state_;
  std::set<ir::VariableId> seen_;
};

// The kind of the first value that has one; else a flag of 0 and 1, a count of whole numbers, or a ratio.
ir::Kind resultKind(const State& state, std::uint32_t variable) {
  std::vector<ir::ExpressionPtr> values;
  for (const ir::CycleStatement& one : state.cycle.body) {
    const auto* store = std::get_if<ir::Store>(&one.node);
    const double* number = store == nullptr ? nullptr : ir::constantValue(store->number);
    if (number != nullptr && *number == variable) values.push_back(store->value);
  }
  std::set<double> constants;
  for (const ir::ExpressionPtr& one : values) {
    const ir::Kind kind = kindOf(state, one);
    if (kind != ir::Kind::Number) return kind;
    if (isArea(state, one)) return ir::Kind::Length; // refused where it is read
    if (const double* constant = ir::constantValue(one)) constants.insert(*constant);
  }
  const bool whole = std::all_of(values.begin(), values.end(),
                                 [&](const ir::ExpressionPtr& one) { return Values(state).isWhole(one); });
  if (!whole) return ir::Kind::Ratio;
  const bool alone = std::all_of(values.begin(), values.end(), [](const ir::ExpressionPtr& one) {
    return ir::constantValue(one) != nullptr;
  });
  return alone && constants == std::set<double>{0, 1} ? ir::Kind::Flag : ir::Kind::Count;
}

// A number beside lengths is one of them.
std::string resultText(State& state, const ir::ExpressionPtr& value, ir::Kind kind, SourceRange range) {
  const ir::Kind own = kindOf(state, value);
  return valueText(state, value, own == ir::Kind::Number ? kind : own, range);
}

} // namespace

void writeResult(State& state, const ir::Store& node, const ir::Origin& origin) {
  const SourceRange range = origin.range();
  const double* number = ir::constantValue(node.number);
  if (number == nullptr)
    return state.refuse(range, "a variable whose number is computed", "leave each value under its own name");
  const auto variable = static_cast<std::uint32_t>(*number);
  const ir::Kind kind = resultKind(state, variable);
  const std::string value = resultText(state, node.value, kind, range);
  if (value.empty()) return;
  auto known = state.kept.find(variable);
  if (known == state.kept.end()) {
    std::string base = "value";
    std::string title = "Value";
    if (const auto* result = std::get_if<ir::MeasuredResult>(&node.value->node)) {
      const bool main = result->name == ir::ResultName::Main;
      base = main ? "measured" : std::string(ir::resultText(result->name));
      std::replace(base.begin(), base.end(), '-', '_');
      if (state.options.isReserved(base)) base = "position_" + base;
      title = main ? "Measured value" : "Measured: " + std::string(ir::resultTitle(result->name));
      if (main)
        state.note(range, "what the macros leave as their result, which their set does not name",
                   "it is read as the position of a surface, and as the size of a feature");
    }
    const std::string name = state.fresh(base);
    known = state.kept.emplace(variable, name).first;
    state.results.emplace_back(name, kind);
    state.resultTitles[name] = fmt::format("{}, #{} of the source", title, variable);
  }
  state.add(known->second + " = " + value, origin);
}

} // namespace dotek::backends::cycle
