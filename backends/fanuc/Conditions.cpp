// Conditions as jumps: joined in one IF where the control has that, else as several.
#include "backends/fanuc/MacroNames.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Fold.h"
#include "support/messages/Fanuc.h"

#include <algorithm>

namespace dotek::backends::fanuc {

namespace {

// Negations only around IsNull.
ir::ConditionPtr pushedIn(const ir::ConditionPtr& condition) {
  return ir::simplify(ir::negate(ir::negate(condition)));
}

bool isAtomic(const ir::ConditionPtr& condition) {
  return !std::holds_alternative<ir::Junction>(condition->node) &&
         !std::holds_alternative<ir::Truth>(condition->node);
}

std::string nullText(State& state, const ir::IsNull& test, std::string_view relation,
                     const ir::Origin& origin, std::uint32_t depth) {
  // A helper keeps the null of what is no variable: only a plain assignment copies it.
  const bool plain = std::holds_alternative<ir::VariableUse>(test.value->node) ||
                     std::holds_alternative<ir::MachineVariable>(test.value->node);
  if (plain) return operandText(state, test.value, origin, depth) + std::string(relation) + "#0";
  const std::uint32_t local = state.helper();
  if (local == 0) {
    state.refuse<diag::ExpressionDepth>(origin.range(), state.control.title);
    return "#0 EQ #0";
  }
  const std::string name = "#" + std::to_string(local);
  assign(state, name, test.value, origin);
  return name + std::string(relation) + "#0";
}

// Without the brackets of the IF.
std::string atomText(State& state, const ir::ConditionPtr& condition, const ir::Origin& origin,
                     std::uint32_t depth) {
  if (const auto* test = std::get_if<ir::IsNull>(&condition->node))
    return nullText(state, *test, " EQ ", origin, depth);
  if (const auto* inverse = std::get_if<ir::Not>(&condition->node)) {
    if (const auto* test = std::get_if<ir::IsNull>(&inverse->inner->node))
      return nullText(state, *test, " NE ", origin, depth);
    return atomText(state, ir::negate(inverse->inner), origin, depth);
  }
  const auto& comparison = std::get<ir::Comparison>(condition->node);
  const bool orders =
      comparison.relation != ir::Relation::Equal && comparison.relation != ir::Relation::NotEqual;
  // An empty variable counts as 0 where the control asks for the greater one.
  const auto bare = [&](const ir::ExpressionPtr& side) {
    const auto* unary = std::get_if<ir::Unary>(&side->node);
    return orders && unary != nullptr && unary->op == ir::UnaryOp::NullAsZero ? unary->operand : side;
  };
  const std::string left = operandText(state, bare(comparison.left), origin, depth);
  return left + " " + std::string(relationName(comparison.relation)) + " " +
         operandText(state, bare(comparison.right), origin, depth);
}

// One IF says it. Two comparisons are joined, not more: longer chains are not in any source.
bool fitsOneIf(const State& state, const ir::ConditionPtr& condition) {
  if (isAtomic(condition)) return true;
  const auto* junction = std::get_if<ir::Junction>(&condition->node);
  return junction != nullptr && state.control.joinedConditions && state.control.bracketDepth > 2 &&
         isAtomic(junction->left) && isAtomic(junction->right);
}

// "IF[..]"
std::string ifText(State& state, const ir::ConditionPtr& condition, const ir::Origin& origin) {
  const std::uint32_t depth = std::max(1u, state.control.bracketDepth) - 1;
  const auto* junction = std::get_if<ir::Junction>(&condition->node);
  if (junction == nullptr) return "IF[" + atomText(state, condition, origin, depth) + "]";
  const std::string left = atomText(state, junction->left, origin, depth - 1);
  const std::string right = atomText(state, junction->right, origin, depth - 1);
  return "IF[[" + left + "]" + (junction->op == ir::Connective::And ? "AND" : "OR") + "[" + right + "]]";
}

void jump(State& state, const ir::ConditionPtr& condition, Mark target, const ir::Origin& origin) {
  if (const auto* truth = std::get_if<ir::Truth>(&condition->node)) {
    if (truth->value) state.sheet.jump("GOTO ", target, origin);
    return;
  }
  const auto* joined = std::get_if<ir::Junction>(&condition->node);
  if (joined == nullptr) demand(state, variablesOf(condition), origin);
  if (fitsOneIf(state, condition) && !demandsWithin(state, condition)) {
    const std::string text = ifText(state, condition, origin);
    state.sheet.jump(text + "GOTO ", target, origin);
    return;
  }
  const ir::Junction& junction = *joined;
  if (junction.op == ir::Connective::Or) {
    jump(state, junction.left, target, origin);
    jump(state, junction.right, target, origin);
    return;
  }
  const Mark skip = state.mark();
  jump(state, pushedIn(ir::negate(junction.left)), skip, origin);
  const std::set<ir::VariableId> toAsk = state.toAsk;
  jump(state, junction.right, target, origin);
  state.sheet.place(skip);
  state.toAsk = toAsk;
}

} // namespace

void jumpIf(State& state, const ir::ConditionPtr& condition, Mark target, const ir::Origin& origin) {
  jump(state, pushedIn(condition), target, origin);
}

void doIf(State& state, const ir::ConditionPtr& given, const std::string& statement,
          const ir::Origin& origin) {
  const ir::ConditionPtr condition = pushedIn(given);
  if (const auto* truth = std::get_if<ir::Truth>(&condition->node)) {
    if (truth->value) state.sheet.add(statement, origin);
    return;
  }
  if (state.control.ifThen && fitsOneIf(state, condition)) {
    const std::string text = ifText(state, condition, origin);
    state.sheet.add(text + "THEN " + statement, origin);
    return;
  }
  const Mark skip = state.mark();
  jump(state, pushedIn(ir::negate(condition)), skip, origin);
  state.sheet.add(statement, origin);
  state.sheet.place(skip);
}

} // namespace dotek::backends::fanuc
