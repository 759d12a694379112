#include "lint/NcProgram.h"
#include "lint/Skips.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const auto& modes = nc.modes();
  Diagnostic* first = nullptr; // the mode that is missing is one cause for all of them
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const ir::NcBlock* skip = skipOf(program.body[i]);
    if (skip == nullptr || axesOf(*skip) == 0 || !modes[i] || *modes[i] != DistanceMode::AsBefore) continue;
    if (statedMode(program.body[i])) continue;
    if (first != nullptr)
      first->note(program.body[i].origin.range(), "and this one");
    else
      first = &report.at(
          program.body[i].origin.range(),
          "neither G90 nor G91 is before this G31; in the other mode of the caller the stylus goes "
          "elsewhere, and the path may be too long; state the mode here");
  }
}

} // namespace

DOTEK_LINT_RULE(skip_in_callers_mode){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
