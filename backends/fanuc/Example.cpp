#include "backends/fanuc/Example.h"
#include "ir/Evaluate.h"

namespace dotek::backends::fanuc {

namespace {

constexpr std::uint32_t kMaxSteps = 10000;
constexpr int kMostTries = 2000;
constexpr double kLengths[] = {10, 20, 30, 5, 50, 2, 100, 1, 4, 8, 0.5, 200, -10, -5, 45, 90, 3, 6, 0};

double typical(const ir::Variable& variable) {
  if (variable.defaultValue) return *variable.defaultValue;
  if (variable.kind == ir::Kind::WorkOffset) return 54;
  if (variable.kind == ir::Kind::ToolOffset || variable.kind == ir::Kind::Count) return 1;
  if (variable.kind == ir::Kind::Feed) return 1000;
  if (variable.role != ir::Role::Host) return 0;
  if (variable.name == "clearance") return 50;
  if (variable.name == "retract") return 5;
  if (variable.name == "tool_radius") return 3;
  if (variable.name == "return_feed") return 1000;
  return 0;
}

} // namespace

std::map<ir::VariableId, double> exampleValues(const State& state) {
  std::map<ir::VariableId, double> out;
  ir::Environment all(state.cycle.variables.size());
  std::vector<ir::VariableId> open; // what the caller has to choose
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ir::Variable& variable = state.cycle.variables[i];
    if (variable.role == ir::Role::Local) continue;
    const auto fixed = state.options.fixed.find(variable.name);
    all[i] = ir::Scalar::of(fixed != state.options.fixed.end() ? fixed->second : typical(variable));
  }
  for (const Argument& argument : state.arguments) {
    const ir::Variable& variable = state.cycle.variable(argument.variable);
    out[argument.variable] = typical(variable);
    if (variable.defaultValue) continue;
    if (variable.optional)
      all[argument.variable] = ir::Scalar::null();
    else if (variable.role == ir::Role::Parameter &&
             (variable.kind == ir::Kind::Length || variable.kind == ir::Kind::Angle ||
              variable.kind == ir::Kind::Number || variable.kind == ir::Kind::Ratio))
      open.push_back(argument.variable);
  }
  const auto passes = [&] {
    return ir::runChecks(state.cycle, all, kMaxSteps).end == ir::CheckRun::End::Passes;
  };
  if (open.empty() || passes()) return out;
  std::uint32_t draw = 1; // the same draws in each run
  for (int n = 0; n < kMostTries; ++n) {
    for (const ir::VariableId id : open) {
      draw = draw * 1664525U + 1013904223U;
      all[id] = ir::Scalar::of(kLengths[(draw >> 16U) % std::size(kLengths)]);
    }
    if (!passes()) continue;
    for (const ir::VariableId id : open)
      out[id] = all[id].value;
    break;
  }
  return out;
}

} // namespace dotek::backends::fanuc
