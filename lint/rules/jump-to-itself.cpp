#include "lint/NcProgram.h"
#include "lint/Probing.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  // A jump right back to its own block, with nothing but labels and comments between: nothing can change.
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const auto* jump = std::get_if<ir::Jump>(&program.body[i].node);
    if (jump == nullptr) continue;
    for (std::size_t back = i; back-- > 0;) {
      const auto* label = std::get_if<ir::Label>(&program.body[back].node);
      if (label != nullptr && label->label == jump->target) {
        report.at(program.body[i].origin.range(),
                  "the jump goes to its own block; the control is here for ever, "
                  "without an alarm; jump to the block that is meant, or stop with "
                  "#3000 or M0");
        break;
      }
      if (!ir::isLayout(program.body[back])) break;
    }
  }
}

} // namespace

DOTEK_LINT_RULE(jump_to_itself){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
