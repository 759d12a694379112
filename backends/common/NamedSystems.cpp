#include "backends/common/NamedSystems.h"

#include "ir/Walk.h"

#include <cmath>
#include <map>

namespace dotek::backends {
namespace {

constexpr double kFirstSystem = 54, kLastSystem = 59;
constexpr std::uint32_t kMaxSteps = 10000;
constexpr int kMostTried = 400; // numbers of an argument

} // namespace

bool namesSystem(double number, const ExtendedSystems& extended) {
  constexpr double kSame = 1e-6;
  if (number >= kFirstSystem && number <= kLastSystem) return number == std::trunc(number);
  if (extended.first == 0 || number < extended.first - kSame || number > extended.last + kSame) return false;
  const double steps = (number - extended.first) / extended.step;
  return std::abs(steps - std::round(steps)) <= kSame / extended.step;
}

ir::Environment withLocals(const ir::Cycle& cycle, ir::Environment environment) {
  std::map<ir::VariableId, int> assigned;
  for (const auto* list : {&cycle.checks, &cycle.body})
    for (const ir::CycleStatement& statement : *list)
      if (const auto* assign = std::get_if<ir::Assign>(&statement.node)) ++assigned[assign->variable];
  for (const ir::CycleStatement& statement : cycle.checks) {
    const auto* assign = std::get_if<ir::Assign>(&statement.node);
    if (assign != nullptr && assigned[assign->variable] == 1)
      environment[assign->variable] = ir::evaluate(*assign->value, environment);
  }
  return environment;
}

std::vector<ir::Environment> environmentsOf(const ir::Cycle& cycle) {
  std::vector<ir::Environment> out;
  for (const double shift : {0.0, 1000.0, -1000.0}) {
    ir::Environment environment(cycle.variables.size());
    for (std::size_t i = 0; i < environment.size(); ++i)
      if (cycle.variables[i].role != ir::Role::Local)
        environment[i] = ir::Scalar::of(cycle.variables[i].defaultValue.value_or(0) + shift);
    out.push_back(std::move(environment));
  }
  return out;
}

std::set<ir::VariableId> givenFor(const ir::Cycle& cycle, const ir::ExpressionPtr& value) {
  std::set<ir::VariableId> out, seen;
  std::vector<ir::ExpressionPtr> open = {value};
  while (!open.empty()) {
    const ir::ExpressionPtr now = open.back();
    open.pop_back();
    std::set<ir::VariableId> used;
    ir::eachNode(now, [&](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) used.insert(use->variable);
    });
    for (const ir::VariableId id : used) {
      if (!seen.insert(id).second) continue;
      if (cycle.variable(id).role != ir::Role::Local) out.insert(id);
      for (const ir::CycleStatement& statement : cycle.checks)
        if (const auto* assign = std::get_if<ir::Assign>(&statement.node);
            assign != nullptr && assign->variable == id)
          open.push_back(assign->value);
    }
  }
  return out;
}

std::optional<NoSystem> passesNoSystem(const ir::Cycle& cycle, ir::VariableId id,
                                       const ir::ExpressionPtr& system, const ExtendedSystems& extended) {
  constexpr double kNone = 99999;
  for (ir::Environment& environment : environmentsOf(cycle)) {
    const auto alarm = [&](double value) {
      environment[id] = ir::Scalar::of(value);
      const ir::CheckRun run = ir::runChecks(cycle, environment, kMaxSteps);
      return run.end == ir::CheckRun::End::Alarm ? run.at : nullptr;
    };
    const ir::CycleStatement *const above = alarm(kNone), *const below = alarm(-kNone);
    if (above == nullptr || below == nullptr) continue;
    std::optional<NoSystem> first;
    for (int value = 0; value <= kMostTried; ++value) {
      if (const auto* const end = alarm(value); end == above || end == below) continue;
      const ir::Scalar named = ir::evaluate(*system, withLocals(cycle, environment));
      if (!named.known() || namesSystem(named.value, extended)) return std::nullopt;
      if (!first) first = {static_cast<double>(value), named.value};
    }
    if (first) return first;
  }
  return std::nullopt;
}

} // namespace dotek::backends
