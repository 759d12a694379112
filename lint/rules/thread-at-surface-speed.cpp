#include "ir/Flow.h"
#include "lint/NcProgram.h"
#include "lint/Turning.h"

#include <set>

namespace dotek::lint::rule {
namespace {

using stdlib::Function;

void check(const NcProgram& nc, Report& report) {
  if (!isForLathe(nc.project)) return;
  const stdlib::Control& control = *nc.project.control;
  std::set<ir::LabelId> targets;
  bool computed = false;
  for (const ir::ProgramStatement& statement : nc.program.body) {
    if (const auto target = ir::targetOf(statement)) targets.insert(*target);
    computed = computed || ir::isComputedJump(statement);
  }
  const ir::Word* on = nullptr; // nullptr: off, or not certain
  for (const ir::ProgramStatement& statement : nc.program.body) {
    // There another mode may be in force.
    const auto* label = std::get_if<ir::Label>(&statement.node);
    if (callOf(statement) != nullptr || (label != nullptr && (computed || targets.contains(label->label))))
      on = nullptr;
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    if (wordOf(*block, control, Function::SurfaceSpeedOff) != nullptr) on = nullptr;
    if (const ir::Word* begins = wordOf(*block, control, Function::SurfaceSpeedOn)) on = begins;
    if (on == nullptr) continue;
    for (const Function thread : {Function::Thread, Function::ThreadingCycle, Function::ThreadPasses}) {
      const ir::Word* word = wordOf(*block, control, thread);
      if (word == nullptr) continue;
      report
          .at(word->range,
              "a thread while constant surface speed is on; the spindle changes its speed with X, and the "
              "passes of "
              "the thread no longer begin in the same place; write `G97 S` with a speed before it")
          .note(on->range, "it has been on since this block");
      return;
    }
  }
}

} // namespace

DOTEK_LINT_RULE(thread_at_surface_speed){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
