// Which values of an argument the checks let pass: tried around every constant that they compare with.
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Evaluate.h"
#include "ir/Walk.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends::fanuc {

namespace {

constexpr std::uint32_t kMaxSteps = 10000;
constexpr double kFar = 1e6;
constexpr double kSmallRadius = 0.001; // mm
constexpr std::size_t kMostConstants = 64;

// Arguments that a local of the checks may stand for, through assignments.
std::map<ir::VariableId, std::set<ir::VariableId>> sources(const ir::Cycle& cycle) {
  std::map<ir::VariableId, std::set<ir::VariableId>> out;
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (cycle.variable(id).role != ir::Role::Local) out[id].insert(id);
  for (bool changed = true; changed;) {
    changed = false;
    for (const ir::CycleStatement& statement : cycle.checks) {
      const auto* assign = std::get_if<ir::Assign>(&statement.node);
      if (assign == nullptr) continue;
      auto& into = out[assign->variable];
      const std::size_t before = into.size();
      for (const ir::VariableId read : variablesOf(assign->value)) {
        const std::set<ir::VariableId> from = out[read];
        into.insert(from.begin(), from.end());
      }
      changed = changed || into.size() != before;
    }
  }
  return out;
}

struct Compared {
  bool alone = true; // no comparison holds another argument beside this one
  bool any = false;
  std::set<double> constants;
};

void visit(const ir::ConditionPtr& condition, const std::function<void(const ir::Comparison&)>& each) {
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node)) each(*comparison);
  if (const auto* inverse = std::get_if<ir::Not>(&condition->node)) visit(inverse->inner, each);
  if (const auto* junction = std::get_if<ir::Junction>(&condition->node)) {
    visit(junction->left, each);
    visit(junction->right, each);
  }
}

Compared comparedWith(const ir::Cycle& cycle, ir::VariableId id) {
  const auto from = sources(cycle);
  Compared out;
  for (const ir::CycleStatement& statement : cycle.checks) {
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* constant = std::get_if<ir::Constant>(&node.node)) {
        out.constants.insert(constant->value);
        out.constants.insert(-constant->value);
      }
    });
    const auto* branch = std::get_if<ir::Branch>(&statement.node);
    if (branch == nullptr) continue;
    visit(branch->condition, [&](const ir::Comparison& comparison) {
      std::set<ir::VariableId> all;
      for (const auto& side : {comparison.left, comparison.right})
        for (const ir::VariableId read : variablesOf(side))
          if (const auto found = from.find(read); found != from.end())
            all.insert(found->second.begin(), found->second.end());
      if (!all.contains(id)) return;
      out.any = true;
      out.alone = out.alone && all.size() == 1;
    });
  }
  return out;
}

// The others at their defaults.
ir::Environment others(const State& state) {
  ir::Environment out(state.cycle.variables.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const ir::Variable& variable = state.cycle.variables[i];
    if (variable.role == ir::Role::Local) continue;
    const auto fixed = state.options.fixed.find(variable.name);
    const double value = variable.name == "tool_radius" && variable.role == ir::Role::Host
                             ? (fixed != state.options.fixed.end() ? fixed->second : kSmallRadius)
                             : variable.defaultValue.value_or(0);
    out[i] = ir::Scalar::of(value);
  }
  return out;
}

std::string bound(double value) {
  return numberText(Decimal::of(value).rounded(6).value());
}

} // namespace

std::string rangeText(const State& state, ir::VariableId id) {
  const Compared compared = comparedWith(state.cycle, id);
  if (!compared.any) return "";
  constexpr const char* kSee = "SEE ALARMS";
  if (!compared.alone || compared.constants.size() > kMostConstants) return kSee;
  ir::Environment environment = others(state);
  const auto passes = [&](double value) {
    environment[id] = ir::Scalar::of(value);
    return ir::runChecks(state.cycle, environment, kMaxSteps).end == ir::CheckRun::End::Passes;
  };
  // What the dialog offers and the others at their defaults reject is no limit of this one.
  if (const auto list = state.options.choices.find(id); list != state.options.choices.end())
    if (std::any_of(list->second.begin(), list->second.end(),
                    [&](const Choice& choice) { return !passes(choice.value); }))
      return kSee;
  // Constants and the gaps between them, in turn: gap, constant, gap, ..., gap.
  std::vector<double> at(compared.constants.begin(), compared.constants.end());
  std::vector<bool> good;
  for (std::size_t i = 0; i <= at.size(); ++i) {
    const double low = i == 0 ? -kFar : at[i - 1];
    const double high = i == at.size() ? kFar : at[i];
    good.push_back(passes(low + (high - low) / 2));
    if (i < at.size()) good.push_back(passes(at[i]));
  }
  const auto first = std::find(good.begin(), good.end(), true);
  if (first == good.end()) return kSee;
  const auto last = std::find(first, good.end(), false);
  if (std::find(last, good.end(), true) != good.end()) return kSee;
  const auto from = static_cast<std::size_t>(first - good.begin());
  const auto to = static_cast<std::size_t>(last - good.begin()) - 1;
  const bool openLow = from == 0, openHigh = to + 1 == good.size();
  if (openLow && openHigh) return "";
  const auto& fallback = state.cycle.variable(id).defaultValue;
  if (fallback && !passes(*fallback)) return kSee;
  const double low = openLow ? 0 : at[(from - 1) / 2];
  const double high = openHigh ? 0 : at[to / 2];
  const bool lowIn = from % 2 == 1, highIn = to % 2 == 1; // the constant itself passes
  if (openLow) return (highIn ? "UP TO " : "BELOW ") + bound(high);
  if (openHigh) return lowIn ? "FROM " + bound(low) : "ABOVE " + bound(low);
  if (lowIn && highIn) return bound(low) + " TO " + bound(high);
  return (lowIn ? "FROM " : "ABOVE ") + bound(low) + (highIn ? " TO " : " BELOW ") + bound(high);
}

} // namespace dotek::backends::fanuc
