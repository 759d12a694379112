#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

void checkProgram(const ir::Program& program, const Probing& probing, Report& report) {
  if (!endsProgram(program)) return;
  const ir::ProgramStatement* first = nullptr;
  bool change = false;
  bool measures = false;
  for (const ir::ProgramStatement& statement : program.body) {
    const ProbeStep step = probing.step(statement);
    measures = measures || skipOf(statement) != nullptr || step.kind == ProbeStep::Kind::Measure ||
               probing.skips(step.program);
    // A program that is called may choose.
    if (step.kind == ProbeStep::Kind::Call || callOf(statement) != nullptr) {
      const ir::Call* call = callOf(statement);
      if (call->kind == ir::CallKind::Subprogram) return;
    }
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    change = change || hasCode(*block, 'M', 6);
    if (choosesSystem(*block) || hasCode(*block, 'G', 52) || hasCode(*block, 'G', 92)) return;
    if (std::any_of(block->words.begin(), block->words.end(), [](const ir::Word& word) {
          return word.address == 'G' && ir::constantValue(word.value) == nullptr;
        }))
      return; // a code that is computed
    if (first == nullptr && isPlainMove(statement) && (axesOf(*block) & 3) != 0) first = &statement;
  }
  if (!change || !measures || first == nullptr) return;
  report.at(
      first->origin.range(),
      "the program moves and measures, and chooses no work offset; its coordinates count in the one that was "
      "left in force; write G54 to G59 before the first move");
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc.program, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(work_offset_not_chosen){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
