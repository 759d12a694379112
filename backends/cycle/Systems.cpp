// Work offsets that the checks count anew, 1 for G54 of a field that holds 54.
#include "backends/cycle/State.h"
#include "ir/Match.h"
#include "ir/Rewrite.h"

#include <optional>

namespace dotek::backends::cycle {

namespace {

// `parameter + by`.
struct Counted {
  ir::ExpressionPtr parameter;
  double by = 0;
};

std::optional<Counted> countedFrom(const ir::ExpressionPtr& value) {
  if (std::holds_alternative<ir::VariableUse>(value->node)) return Counted{value, 0};
  const auto* sum = std::get_if<ir::Binary>(&value->node);
  if (sum == nullptr || (sum->op != ir::BinaryOp::Add && sum->op != ir::BinaryOp::Subtract))
    return std::nullopt;
  const bool add = sum->op == ir::BinaryOp::Add;
  const double* left = ir::constantValue(sum->left);
  const double* right = ir::constantValue(sum->right);
  if (right != nullptr) {
    auto out = countedFrom(sum->left);
    if (out) out->by += add ? *right : -*right;
    return out;
  }
  if (left == nullptr || !add) return std::nullopt;
  auto out = countedFrom(sum->right);
  if (out) out->by += *left;
  return out;
}

bool setsSystems(const ir::CycleStatement& statement) {
  return ir::match(
      statement, [](const ir::OneOf<ir::Measure, ir::CallCycle> auto&) { return true; },
      [](const ir::OneOf<ir::Move, ir::Label, ir::Jump, ir::Branch, ir::Store, ir::ProbePower, ir::Comment,
                         ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop,
                         ir::Alarm, ir::OpaqueBlock> auto&) { return false; });
}

} // namespace

void nameSystems(State& state, const Checked& checked) {
  std::map<ir::VariableId, Counted> counted;
  for (const auto& [id, value] : checked.locals) {
    if (state.cycle.variable(id).kind != ir::Kind::WorkOffset) continue;
    auto from = countedFrom(value);
    if (from) counted.emplace(id, std::move(*from));
  }
  if (counted.empty()) return;
  const auto named = [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
    if (const auto* use = std::get_if<ir::VariableUse>(&node->node)) {
      const auto at = counted.find(use->variable);
      if (at == counted.end()) return node;
      return at->second.by == 0 ? at->second.parameter
                                : ir::binary(ir::BinaryOp::Add, at->second.parameter,
                                             ir::constant(at->second.by), node->range);
    }
    if (!std::holds_alternative<ir::Binary>(node->node)) return node;
    const auto sum = countedFrom(node);
    return sum && sum->by == 0 ? sum->parameter : node;
  };
  for (ir::CycleStatement& statement : state.cycle.body)
    if (setsSystems(statement)) ir::rewrite(statement, named);
  for (const auto& [id, from] : counted)
    state.shifts.erase(id);
}

} // namespace dotek::backends::cycle
