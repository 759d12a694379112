#include "backends/common/NamedSystems.h"

#include "ir/Fold.h"
#include "ir/Walk.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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

bool passOnly(const ir::Cycle& cycle, const ir::ExpressionPtr& value, const std::vector<double>& beside,
              const std::function<bool(double)>& accepts) {
  const std::set<ir::VariableId> given = givenFor(cycle, value);
  if (given.size() != 1) return false;
  std::vector<double> tried = {-99999, 0.5, 1.5, 54.5, 99999};
  for (int one = -1; one <= kMostTried; ++one)
    tried.push_back(one);
  tried.insert(tried.end(), beside.begin(), beside.end());
  bool passes = false;
  for (ir::Environment& environment : environmentsOf(cycle))
    for (const double one : tried) {
      environment[*given.begin()] = ir::Scalar::of(one);
      if (ir::runChecks(cycle, environment, kMaxSteps).end == ir::CheckRun::End::Alarm) continue;
      const ir::Scalar there = ir::evaluate(*value, withLocals(cycle, environment));
      if (!there.known() || !accepts(there.value)) return false;
      passes = true;
    }
  return passes;
}

bool isBeyond(const ir::Cycle& cycle, const ir::ExpressionPtr& system, const ExtendedSystems& extended) {
  if (extended.first == 0) return false;
  const auto beyond = [&](double value) { return value > kLastSystem && namesSystem(value, extended); };
  if (const double* value = ir::constantValue(ir::simplify(system))) return beyond(*value);
  std::vector<double> numbers;
  for (double one = extended.first; one < extended.last + extended.step; one += extended.step)
    numbers.push_back(one - kFirstSystem + 1);
  return passOnly(cycle, system, numbers, beyond);
}

ir::ExpressionPtr beyondIndex(const ir::ExpressionPtr& from, const ExtendedSystems& extended) {
  if (extended.step == 1) return from;
  // S154.01 is no number that a control holds exactly.
  return ir::unary(ir::UnaryOp::Round,
                   ir::binary(ir::BinaryOp::Multiply, from, ir::constant(std::round(1 / extended.step))));
}

const stdlib::MacroArgument* extendedArgument(const stdlib::MacroSignature& signature) {
  const auto found = std::find_if(signature.arguments.begin(), signature.arguments.end(),
                                  [](const stdlib::MacroArgument& one) {
                                    return one.role == stdlib::ArgumentRole::System && one.extendedFirst != 0;
                                  });
  return found == signature.arguments.end() ? nullptr : &*found;
}

const stdlib::MacroArgument* extendedArgument(const stdlib::MacroSet* set) {
  if (set == nullptr) return nullptr;
  for (const stdlib::MacroSignature& signature : set->signatures)
    if (const stdlib::MacroArgument* found = extendedArgument(signature)) return found;
  return nullptr;
}

ExtendedSystems extendedNumbers(const stdlib::MacroArgument* source, const stdlib::MacroArgument* target,
                                const stdlib::Control& control) {
  if (source == nullptr || !control.variables.extendedX) return {};
  const auto most = [](const stdlib::MacroArgument& one) {
    return stdlib::extendedSystem(one, one.extendedLast);
  };
  std::uint32_t count = std::min(most(*source), static_cast<std::uint32_t>(control.variables.extendedCount));
  if (target != nullptr) count = std::min(count, most(*target));
  if (count == 0) return {};
  return {source->extendedFirst + kFirstSystem - 1, stdlib::extendedNumber(*source, count) + kFirstSystem - 1,
          source->extendedStep};
}

SystemWords systemWords(double number, const stdlib::MacroSet* source, const stdlib::Control& control,
                        std::string otherwise) {
  const ExtendedSystems extended = extendedNumbers(extendedArgument(source), nullptr, control);
  if (number <= kLastSystem || !namesSystem(number, extended))
    return {numberText(number), std::move(otherwise)};
  const int n = static_cast<int>(std::lround((number - extended.first) / extended.step)) + 1;
  return {numberText(number) + " (additional system P" + std::to_string(n) + ")",
          "take macros that set it (`--probe-macros dotek`)"};
}

} // namespace dotek::backends
