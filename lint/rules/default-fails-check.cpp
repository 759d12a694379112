#include "frontend/gibbs/Run.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <array>
#include <map>

namespace dotek::lint::rule {
namespace {

using Verdict = gibbs::ChecksResult::Verdict;

constexpr std::array kRadii = {0.05, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0}; // mm
constexpr std::uint32_t kMostSteps = 20000; // of one run; checks of a dialog take some dozens
constexpr std::array kTrials = {1.0, -1.0, 20.0, -20.0, 500.0, -500.0, 56.0};

class Runner {
public:
  Runner(const gibbs::Cycle& cycle, const Project& project)
      : cycle_(cycle), project_(project), limits_(project.limits) {
    limits_.steps = std::min(limits_.steps, kMostSteps);
  }

  gibbs::ChecksResult run(const std::map<std::string, double>& fields, double radius) const {
    Diagnostics ignored;
    gibbs::RunContext context{project_.sources,
                              project_.gibbsKeywords,
                              limits_,
                              ignored,
                              fields,
                              {{"tool_radius", radius}, {"tool_number", 1}},
                              {},
                              [](const std::string&, SourceRange) -> const gibbs::Macro* { return nullptr; },
                              [&](const std::string&, SourceRange) -> const gibbs::Dialog* {
                                return cycle_.dialog ? &*cycle_.dialog : nullptr;
                              }};
    return gibbs::runChecks(*cycle_.cycleData, context);
  }

  // Rejected whatever the tool; the message of the first run.
  std::optional<gibbs::Rejection> rejected(const std::map<std::string, double>& fields) const {
    std::optional<gibbs::Rejection> first;
    for (const double radius : kRadii) {
      const gibbs::ChecksResult result = run(fields, radius);
      if (result.verdict != Verdict::Rejected || result.rejections.empty()) return std::nullopt;
      if (!first) first = result.rejections.front();
    }
    return first;
  }

private:
  const gibbs::Cycle& cycle_;
  const Project& project_;
  Limits limits_;
};

void checkCycle(const gibbs::Cycle& cycle, const Project& project, Report& report) {
  if (!cycle.cycleData || cycle.cycleData->hasErrorNodes || !cycle.defineData) return;
  std::map<std::string, double> fields;
  for (const gibbs::Field& field : gibbs::declaredFields(cycle)) {
    if (!field.value) return;
    fields.emplace(gibbs::foldCase(field.name.text), *field.value);
  }
  const Runner runner(cycle, project);
  const std::optional<gibbs::Rejection> rejection = runner.rejected(fields);
  if (!rejection) return;
  // The field whose value is to blame: with another one the same message does not come.
  for (const gibbs::Definition& definition : cycle.defineData->definitions) {
    for (const double trial : kTrials) {
      std::map<std::string, double> other = fields;
      other[gibbs::foldCase(definition.name.text)] = trial;
      const gibbs::ChecksResult result = runner.run(other, kRadii.front());
      if (result.verdict == Verdict::NotRun || result.verdict == Verdict::Depends) return;
      const bool same = result.verdict == Verdict::Rejected && !result.rejections.empty() &&
                        result.rejections.front().range == rejection->range;
      if (same) continue;
      report
          .at(definition.valueRange,
              "the check of the dialog rejects `{}` with this first value, whatever the "
              "tool; the user cannot leave the dialog with OK before he changes it; give a "
              "value that passes",
              definition.name.text)
          .note(rejection->range, "the message that comes");
      return;
    }
  }
  report.at(rejection->range, "the first values of the fields bring this message, whatever the tool");
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles)
    checkCycle(*cycle, project, report);
}

} // namespace

DOTEK_LINT_RULE(default_fails_check){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
