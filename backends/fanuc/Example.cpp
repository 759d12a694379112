#include "backends/fanuc/Example.h"

#include "backends/common/ToolLength.h"
#include "ir/Evaluate.h"

namespace dotek::backends::fanuc {

namespace {

constexpr std::uint32_t kMaxSteps = 10000;
constexpr int kMostTries = 2000;
// What a caller may be shown, the harmless before the large: whoever copies it goes a short way.
constexpr double kPlain[] = {1,  2,  3,  4,   5,   6,  8,  10, 12,  15, 20,  25,  30,  40,  45, 50,
                             60, 80, 90, 0.5, 0.1, -1, -2, -5, -10, 0,  100, 150, 200, 300, 500};
constexpr int kRounds = 3; // one value may only be small once another is

double typical(const ir::Variable& variable) {
  if (variable.defaultValue) return *variable.defaultValue;
  if (variable.kind == ir::Kind::WorkOffset) return 54;
  if (variable.kind == ir::Kind::ToolOffset || variable.kind == ir::Kind::Count) return 1;
  if (variable.kind == ir::Kind::Feed) return 500;
  if (variable.role != ir::Role::Host) return 0;
  if (variable.name == "clearance") return 50;
  if (variable.name == "retract") return 5;
  if (variable.name == "tool_radius") return 3;
  if (variable.name == "return_feed") return 500;
  return 0;
}

// Each open value as far to the front of the list as the checks allow.
template <class Passes>
void makeSmall(const std::vector<ir::VariableId>& open, ir::Environment& all, const Passes& passes) {
  for (int round = 0; round < kRounds; ++round)
    for (const ir::VariableId id : open) {
      const double now = all[id].value;
      for (const double value : kPlain) {
        all[id] = ir::Scalar::of(value);
        if (value == now || passes()) break;
      }
    }
}

} // namespace

std::map<ir::VariableId, double> exampleValues(const State& state) {
  std::map<ir::VariableId, double> out;
  ir::Environment all(state.cycle.variables.size());
  std::vector<ir::VariableId> open; // what the caller has to choose
  const std::vector<LengthOffset> lengths = lengthOffsets(state.cycle, state.control);
  const auto putsLength = [&](ir::VariableId id) {
    return std::any_of(lengths.begin(), lengths.end(), [&](const LengthOffset& offset) {
      const auto* use = std::get_if<ir::VariableUse>(&offset.word->value->node);
      return use != nullptr && use->variable == id;
    });
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ir::Variable& variable = state.cycle.variables[i];
    if (variable.role == ir::Role::Local) continue;
    const auto fixed = state.options.fixed.find(variable.name);
    all[i] = ir::Scalar::of(fixed != state.options.fixed.end() ? fixed->second : typical(variable));
  }
  for (const Argument& argument : state.arguments) {
    const ir::Variable& variable = state.cycle.variable(argument.variable);
    out[argument.variable] = typical(variable);
    // A list may count G54 as 1.
    const auto list = state.options.choices.find(argument.variable);
    if (variable.kind == ir::Kind::WorkOffset && !variable.defaultValue &&
        list != state.options.choices.end() && !list->second.empty() &&
        std::none_of(list->second.begin(), list->second.end(),
                     [](const Choice& one) { return one.value == 54; })) {
      out[argument.variable] = list->second.front().value;
      all[argument.variable] = ir::Scalar::of(list->second.front().value);
    }
    const int last = state.control.variables.toolCount;
    if (putsLength(argument.variable) &&
        (out[argument.variable] <= 0 || (last > 0 && out[argument.variable] > last)))
      out[argument.variable] = 1;
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
      all[id] = ir::Scalar::of(kPlain[(draw >> 16U) % std::size(kPlain)]);
    }
    if (!passes()) continue;
    makeSmall(open, all, passes);
    for (const ir::VariableId id : open)
      out[id] = all[id].value;
    break;
  }
  return out;
}

} // namespace dotek::backends::fanuc
