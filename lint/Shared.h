// Rules whose checks are functions of a front end: `post`, `convert` and `sim` call them as well.
#pragma once

#include "frontend/compost/Check.h"
#include "frontend/gibbs/Check.h"
#include "frontend/macrob/Check.h"
#include "lint/Project.h"

#include <vector>

namespace dotek::lint {

// Progs and cycles that are linted, as the front ends check them.
struct SharedInputs {
  explicit SharedInputs(const Project& project);
  std::vector<compost::CheckedProg> progs;
  std::vector<gibbs::CheckedCycle> cycles;
};

// Computed once a project.
const SharedInputs& sharedOf(const Project& project);

// A rule of the check; `each` runs it on all inputs of its kind.
template <class Input>
constexpr Rule sharedRule(const Check<Input>& check, Tier tier, void (*each)(const Project&, Report&)) {
  Rule rule;
  rule.severity = check.severity;
  rule.tier = tier;
  rule.shared = true;
  rule.check = each;
  return rule;
}

// A check of one Prog.
template <const Check<compost::CheckedProg>& check> constexpr Rule progRule() {
  return sharedRule(check, Tier::Syntax, [](const Project& project, Report& report) {
    for (const compost::CheckedProg& prog : sharedOf(project).progs)
      check.run(prog, report);
  });
}

// A check of one macro, dialog or DefineData.txt.
template <const Check<gibbs::CheckedFile>& check> constexpr Rule fileRule() {
  return sharedRule(check, Tier::Syntax, [](const Project& project, Report& report) {
    for (const gibbs::CheckedFile* file : project.checked)
      check.run(*file, report);
  });
}

// A check of the files of one cycle together.
template <const Check<gibbs::CheckedCycle>& check> constexpr Rule cycleRule() {
  return sharedRule(check, Tier::Bundle, [](const Project& project, Report& report) {
    for (const gibbs::CheckedCycle& cycle : sharedOf(project).cycles)
      check.run(cycle, report);
  });
}

// A check of one NC program.
template <const Check<macrob::CheckedProgram>& check> constexpr Rule programRule() {
  Rule rule = sharedRule<macrob::CheckedProgram>(check, Tier::Syntax, nullptr);
  rule.parsed = check.run;
  return rule;
}

} // namespace dotek::lint
