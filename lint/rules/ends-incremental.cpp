#include "lint/NcProgram.h"
#include "lint/Skips.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const auto& modes = nc.modes();
  const ir::ProgramStatement* set = nullptr;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    if (statedMode(program.body[i]) == DistanceMode::Incremental) set = &program.body[i];
    if (!endsProgram(program.body[i]) || !modes[i] || set == nullptr) continue;
    // G90 acts before the M30 of its block.
    const DistanceMode left = statedMode(program.body[i]).value_or(*modes[i]);
    if (left != DistanceMode::Incremental && left != DistanceMode::Both) continue;
    report
        .at(program.body[i].origin.range(),
            "the program ends with G91 in force; whether M30 takes it back depends on a parameter, and a "
            "program "
            "that states no G90 moves by distances; write G90 before the end")
        .note(set->origin.range(), "G91 is here");
  }
}

} // namespace

DOTEK_LINT_RULE(ends_incremental){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
