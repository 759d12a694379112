#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

enum class Distance : std::uint8_t { AsBefore, Incremental, Absolute, Mixed };

std::optional<Distance> modeOf(const ir::ProgramStatement& statement) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  if (block == nullptr) return std::nullopt;
  std::optional<Distance> out;
  for (const ir::Word& word : block->words) {
    const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
    if (code != nullptr && *code == 91) out = Distance::Incremental;
    if (code != nullptr && *code == 90) out = Distance::Absolute;
    // G#1 may restore what was in force.
    if (word.address == 'G' && code == nullptr) out = Distance::Mixed;
  }
  return out;
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const ir::ProgramStatement* set = nullptr;
  for (const ir::ProgramStatement& statement : program.body)
    if (modeOf(statement) == Distance::Incremental) set = &statement;
  if (set == nullptr) return;
  const auto before = ir::factsBefore<Distance>(
      program.body, nc.flow(), Distance::AsBefore,
      [&](std::size_t at, std::size_t, Distance distance) {
        return modeOf(program.body[at]).value_or(distance);
      },
      [](Distance& into, Distance other) {
        // One path with G91 is enough: the caller goes on in it.
        if (into == other || into == Distance::Incremental) return false;
        const Distance merged = other == Distance::Incremental ? Distance::Incremental : Distance::Mixed;
        const bool changed = into != merged;
        into = merged;
        return changed;
      });
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    if (!std::holds_alternative<ir::Exit>(program.body[i].node) || !before[i]) continue;
    // The block of the M99 may hold a G90 before it.
    if (*before[i] != Distance::Incremental) continue;
    report
        .at(program.body[i].origin.range(),
            "the program returns with G91 in force; the caller's next coordinates are "
            "taken as distances, and the tool goes elsewhere; write G90 before M99")
        .note(set->origin.range(), "G91 is here");
  }
}

} // namespace

DOTEK_LINT_RULE(incremental_left_on){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
