#include "frontend/gibbs/Blame.h"
#include "lint/CalledFiles.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace dotek::lint::rule {
namespace {

using Verdict = gibbs::ChecksResult::Verdict;

constexpr std::array kRadii = {0.05, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0}; // mm
constexpr std::uint32_t kMostSteps = 20000; // of one run; checks of a dialog take some dozens

class Runner {
public:
  Runner(const gibbs::Cycle& cycle, const Project& project)
      : cycle_(cycle), project_(project), limits_(project.limits) {
    limits_.steps = std::min(limits_.steps, kMostSteps);
  }

  // The fields to blame, in the order of DefineData.txt.
  std::vector<const gibbs::Definition*> blamed(const std::map<std::string, double>& fields) const {
    Diagnostics ignored;
    const auto names =
        gibbs::fieldsToBlame(*cycle_.cycleData, cycle_.others, contextOf(fields, kRadii.front(), ignored));
    std::vector<const gibbs::Definition*> out;
    for (const gibbs::Definition& definition : cycle_.defineData->definitions)
      if (std::find(names.begin(), names.end(), gibbs::foldCase(definition.name.text)) != names.end())
        out.push_back(&definition);
    return out;
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
  gibbs::ChecksResult run(const std::map<std::string, double>& fields, double radius) const {
    Diagnostics ignored;
    gibbs::RunContext context = contextOf(fields, radius, ignored);
    return gibbs::runChecks(*cycle_.cycleData, context);
  }

  gibbs::RunContext contextOf(const std::map<std::string, double>& fields, double radius,
                              Diagnostics& ignored) const {
    return {project_.sources,
            project_.gibbsKeywords,
            limits_,
            ignored,
            fields,
            {{"tool_radius", radius}, {"tool_number", 1}},
            {},
            [&](const std::string& name, SourceRange) { return calledMacro(cycle_, name, project_); },
            [&](const std::string&, SourceRange) -> const gibbs::Dialog* {
              return cycle_.dialog ? &*cycle_.dialog : nullptr;
            }};
  }

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
  const auto blamed = runner.blamed(fields);
  if (blamed.empty()) {
    report.at(rejection->range, "the first values of the fields bring this message, whatever the tool");
    return;
  }
  if (blamed.size() == 1) {
    report
        .at(blamed.front()->valueRange,
            "the check of the dialog rejects `{}` with this first value, whatever the "
            "tool; the user cannot leave the dialog with OK before he changes it; give a "
            "value that passes",
            blamed.front()->name.text)
        .note(rejection->range, "the message that comes");
    return;
  }
  std::string names;
  for (std::size_t i = 0; i < blamed.size(); ++i)
    names += (i == 0 ? "`" : i + 1 == blamed.size() ? " and `" : ", `") + blamed[i]->name.text + "`";
  Diagnostic& finding = report.at(blamed.front()->valueRange,
                                  "the check of the dialog rejects the first values of {} together, whatever "
                                  "the tool; the user cannot leave the dialog with OK before he changes one "
                                  "of them; give values that pass",
                                  names);
  finding.note(rejection->range, "the message that comes");
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
