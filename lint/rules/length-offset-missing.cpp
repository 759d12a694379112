#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

void checkProgram(const ir::Program& program, const Probing& probing, Report& report) {
  if (!endsProgram(program)) return;
  const ir::ProgramStatement* change = nullptr;
  bool measures = false;
  bool offset = false;
  for (const ir::ProgramStatement& statement : program.body) {
    const ProbeStep::Kind kind = probing.step(statement).kind;
    // With H or T the call measures a tool, whose length is not known yet.
    const ir::Call* call = callOf(statement);
    if (call != nullptr &&
        std::any_of(call->arguments.begin(), call->arguments.end(),
                    [](const auto& argument) { return argument.letter == 'H' || argument.letter == 'T'; }))
      continue;
    measures = measures || skipOf(statement) != nullptr || kind == ProbeStep::Kind::Measure ||
               kind == ProbeStep::Kind::Protected || probing.skips(probing.step(statement).program);
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    if (hasCode(*block, 'M', 6)) change = &statement;
    for (const ir::Word& word : block->words) {
      const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
      // G43, G44, their forms with a point, and a code that is computed.
      if (word.address == 'G' && (code == nullptr || (*code >= 43 && *code < 45))) offset = true;
    }
  }
  if (change == nullptr || !measures || offset) return;
  report.at(change->origin.range(),
            "the program puts the probe in and measures, and no G43 takes up its length; Z counts from the "
            "nose of the spindle then, and the stylus goes into the part by its length; write G43 H..");
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc.program, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(length_offset_missing){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
