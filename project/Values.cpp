#include "project/Values.h"

#include "frontend/gibbs/Ast.h"
#include "ir/Evaluate.h"
#include "ir/Flow.h"
#include "ir/Fold.h"
#include "ir/Rewrite.h"
#include "project/CycleChecks.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>

namespace dotek::project {

namespace gibbs = frontend::gibbs;

namespace {

// A stylus has some such radius, what else the CAM knows is some such height or place: a check that turns a
// value away for all of them always does.
constexpr double kRadii[] = {0.001, 1, 3, 10};
constexpr double kPlaces[] = {0, 50, -50};

std::vector<std::pair<double, double>> hostValues(const ir::Cycle& cycle) {
  bool radius = false;
  bool place = false;
  for (const ir::Variable& variable : cycle.variables) {
    if (variable.role == ir::Role::Host) (variable.name == "tool_radius" ? radius : place) = true;
  }
  std::vector<std::pair<double, double>> out;
  for (const double r : kRadii) {
    for (const double p : kPlaces) {
      if ((radius || r == kRadii[0]) && (place || p == kPlaces[0])) out.emplace_back(r, p);
    }
  }
  return out;
}

std::string messageOf(const ir::CycleStatement& alarm) {
  const std::string& text = std::get<ir::Alarm>(alarm.node).message;
  return text.empty() ? "no message" : "`" + text + "`";
}

class Values {
public:
  Values(const CycleFolder& folder, LoweredCycle& lowered, Session& session)
      : folder_(folder), lowered_(lowered), session_(session) {}

  // Names and values of fields of which another value lets the rest pass.
  std::vector<std::pair<std::string, double>> blamed() const {
    std::vector<std::pair<std::string, double>> out;
    for (ir::VariableId id = 0; id < cycle().variables.size(); ++id) {
      const ir::Variable& variable = cycle().variable(id);
      const auto fixed = lowered_.fixed.find(id);
      if (variable.role != ir::Role::Parameter || (fixed == lowered_.fixed.end() && !variable.defaultValue))
        continue;
      if (cures(id))
        out.emplace_back(variable.name,
                         fixed != lowered_.fixed.end() ? fixed->second : *variable.defaultValue);
    }
    return out;
  }

  void settle() {
    const ir::CheckRun defaults = tried(environment());
    if (defaults.end != ir::CheckRun::End::Alarm) return;
    const std::vector<ir::VariableId> found = culprits();
    const bool given = std::any_of(found.begin(), found.end(),
                                   [&](ir::VariableId id) { return lowered_.givenDefaults.contains(id); });
    if (found.empty() || given) return reportRejected(folder_, lowered_, *defaults.at, session_);
    for (const ir::VariableId id : found) {
      ir::Variable& variable = cycle().variables[id];
      session_.diagnostics()
          .report<diag::DefaultTurnedAway>(variable.range, variable.name, numberText(*variable.defaultValue),
                                           messageOf(*defaults.at))
          .note(defaults.at->origin.range(), "this check rejects it");
      variable.defaultValue.reset();
    }
  }

private:
  ir::Cycle& cycle() { return lowered_.cycle; }
  const ir::Cycle& cycle() const { return lowered_.cycle; }

  ir::Environment environment() const {
    ir::Environment out(cycle().variables.size());
    for (ir::VariableId id = 0; id < out.size(); ++id) {
      const ir::Variable& variable = cycle().variable(id);
      if (const auto fixed = lowered_.fixed.find(id); fixed != lowered_.fixed.end())
        out[id] = {ir::Scalar::State::Known, fixed->second};
      else if (variable.defaultValue)
        out[id] = {ir::Scalar::State::Known, *variable.defaultValue};
    }
    return out;
  }

  // Ends in an alarm only where every value of the host inputs does.
  ir::CheckRun tried(const ir::Environment& environment) const {
    ir::CheckRun last = ir::runChecks(cycle(), environment, session_.limits().steps);
    if (last.end != ir::CheckRun::End::Unknown) return last;
    for (const auto& [radius, place] : hostValues(cycle())) {
      ir::Environment with = environment;
      for (ir::VariableId id = 0; id < with.size(); ++id) {
        const ir::Variable& variable = cycle().variable(id);
        if (variable.role == ir::Role::Host && !with[id].known())
          with[id] = {ir::Scalar::State::Known, variable.name == "tool_radius" ? radius : place};
      }
      const ir::CheckRun run = ir::runChecks(cycle(), with, session_.limits().steps);
      if (run.end != ir::CheckRun::End::Alarm) return run;
      last = run;
    }
    return last;
  }

  // Values that may make the checks pass: around each constant that they name, and round numbers.
  std::vector<double> candidates() const {
    std::set<double> out = {0, 1, 5, 10, 50, 100, 1000, -1, -5, -10, -50, -100};
    for (const double constant : ir::constantsOf(cycle().checks)) {
      for (const double step : {0.0, 0.001, 1.0, -0.001, -1.0})
        out.insert(constant + step);
    }
    return {out.begin(), out.end()};
  }

  // Whether some other value of the parameter alone lets the rest pass.
  bool cures(ir::VariableId id) const {
    ir::Environment with = environment();
    const std::vector<double> values = candidates();
    return std::any_of(values.begin(), values.end(), [&](double value) {
      with[id] = {ir::Scalar::State::Known, value};
      return tried(with).end == ir::CheckRun::End::Passes;
    });
  }

  // The defaults that are to blame: each of which another value lets the rest pass; none where only another
  // fixed value does; all of them where no single value helps.
  std::vector<ir::VariableId> culprits() const {
    std::vector<ir::VariableId> out;
    std::vector<ir::VariableId> all;
    bool fixedCures = false;
    for (ir::VariableId id = 0; id < cycle().variables.size(); ++id) {
      const ir::Variable& variable = cycle().variable(id);
      const bool fixed = lowered_.fixed.contains(id);
      if (variable.role != ir::Role::Parameter || (!fixed && !variable.defaultValue)) continue;
      if (!fixed) all.push_back(id);
      if (!cures(id)) continue;
      fixedCures = fixedCures || fixed;
      if (!fixed) out.push_back(id);
    }
    return out.empty() && !fixedCures ? all : out;
  }

  const CycleFolder& folder_;
  LoweredCycle& lowered_;
  Session& session_;
};

} // namespace

std::optional<ir::CycleStatement> certainAlarm(const LoweredCycle& lowered) {
  if (lowered.fixed.empty()) return std::nullopt;
  std::optional<ir::CycleStatement> alarm;
  for (const auto& [radius, place] : hostValues(lowered.cycle)) {
    ir::Cycle trial = lowered.cycle;
    trial.body.clear();
    std::map<ir::VariableId, double> values = lowered.fixed;
    for (ir::VariableId id = 0; id < trial.variables.size(); ++id) {
      if (trial.variable(id).role == ir::Role::Host)
        values.emplace(id, trial.variable(id).name == "tool_radius" ? radius : place);
    }
    ir::fold(trial, values);
    const std::vector<bool> reached = ir::reachable(trial.checks);
    const auto next = ir::successors(trial.checks);
    bool passes = trial.checks.empty();
    for (std::size_t i = 0; i < trial.checks.size(); ++i) {
      if (!reached[i]) continue;
      passes = passes || std::find(next[i].begin(), next[i].end(), trial.checks.size()) != next[i].end();
      if (!alarm && std::holds_alternative<ir::Alarm>(trial.checks[i].node)) alarm = trial.checks[i];
    }
    if (passes) return std::nullopt;
  }
  return alarm;
}

void reportRejected(const CycleFolder& folder, const LoweredCycle& lowered, const ir::CycleStatement& alarm,
                    Session& session) {
  LoweredCycle copy = lowered;
  session.diagnostics().report<diag::ValuesRejected>(alarm.origin.range(), folder.name,
                                                     rejectedValues(Values(folder, copy, session).blamed()),
                                                     messageOf(alarm));
}

void applyDefaults(const NamedTexts& given, LoweredCycle& lowered, std::set<std::string>& used,
                   Session& session) {
  std::set<std::string> seen;
  for (const auto& [name, text] : given) {
    const std::string folded = gibbs::foldCase(name);
    for (ir::Variable& variable : lowered.cycle.variables) {
      if (variable.role != ir::Role::Parameter || gibbs::foldCase(variable.name) != folded) continue;
      used.insert(name);
      const std::optional<double> value = parseNumber(text);
      if (!value) {
        session.diagnostics().report<diag::NotANumber>({}, "--default", name, text);
      } else if (!seen.insert(folded).second) {
        session.diagnostics().report<diag::GivenTwice>({}, "--default", name);
      } else {
        variable.defaultValue = value;
        variable.defaultDigits = text;
        lowered.givenDefaults.insert(static_cast<ir::VariableId>(&variable - lowered.cycle.variables.data()));
      }
    }
  }
}

void settleValues(const CycleFolder& folder, LoweredCycle& lowered, Session& session) {
  Values(folder, lowered, session).settle();
}

const JobOperation* operationOf(const CycleFolder& folder, const LoweringInputs& inputs, Session& session) {
  if (!inputs.job) return nullptr;
  const JobOperation* found = nullptr;
  std::size_t points = 0;
  for (const JobOperation& operation : inputs.job->operations) {
    if (operation.cycle != folder.name) continue;
    found = found == nullptr ? &operation : found;
    points += std::max<std::size_t>(operation.at.size(), 1);
  }
  if (points <= 1) return found;
  session.diagnostics().report<diag::PointsOfOperation>(found->cycleRange, folder.name, points);
  return nullptr;
}

void takeOperation(const JobOperation& operation, const CommonOptions& options, LoweringInputs& inputs) {
  std::map<std::string, double> own = operation.hosts;
  if (!operation.at.empty()) {
    own.emplace("start_x", operation.at.front().first);
    own.emplace("start_y", operation.at.front().second);
  }
  for (const auto& [name, value] : own) {
    const bool flag = std::any_of(options.host.begin(), options.host.end(),
                                  [&, &key = name](const auto& given) { return given.first == key; });
    if (!flag) inputs.hosts[name] = value;
  }
  for (const JobValue& value : operation.set) {
    const bool flag = std::any_of(inputs.sets.begin(), inputs.sets.end(), [&](const auto& set) {
      return gibbs::foldCase(set.first) == gibbs::foldCase(value.name);
    });
    if (!flag) inputs.sets.emplace_back(value.name, value.value);
  }
}

} // namespace dotek::project
