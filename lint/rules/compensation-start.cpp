#include "lint/NcProgram.h"

namespace dotek::lint::rule {
namespace {

// The end of it in an arc.
void checkEnd(const ir::NcBlock& block, std::size_t at, const Machining& before, Report& report) {
  const ir::Word* code = codeWord(block, 'G', 40);
  if (code == nullptr || before.mode(Mode::Compensation).on != Certain::Yes) return;
  if (within(block, at, before).motion < 2 || axesOf(block) == 0) return;
  report.at(
      code->range,
      "G40 ends compensation in the block of an arc; the control stops with alarm 34; end it in a straight "
      "move after the arc");
}

// G41 in a block without axes: the first move after it begins the compensation.
void checkFirstMove(const NcProgram& nc, std::size_t at, const ir::Word& code, const char* name,
                    Report& report) {
  const auto& body = nc.program.body;
  for (std::size_t i = at + 1; i < body.size(); ++i) {
    if (std::holds_alternative<ir::Comment>(body[i].node)) continue;
    const auto* block = std::get_if<ir::NcBlock>(&body[i].node);
    if (block == nullptr || hasCode(*block, 'G', 40) || body[i].blockDelete != 0) return;
    if (axesOf(*block) == 0) continue;
    if (hasCode(*block, 'G', 2) || hasCode(*block, 'G', 3))
      report
          .at(body[i].origin.range(),
              "{} begins in this block, an arc, as the block that has it does not move; the control stops "
              "with "
              "alarm 34; begin it in a straight move before",
              name)
          .note(code.range, std::string(name) + " is here");
    return;
  }
}

void check(const NcProgram& nc, Report& report) {
  const auto& facts = nc.machining();
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&nc.program.body[i].node);
    if (block == nullptr || !facts[i]) continue;
    checkEnd(*block, i, *facts[i], report);
    const ir::Word* code = codeWord(*block, 'G', 41);
    if (code == nullptr) code = codeWord(*block, 'G', 42);
    if (code == nullptr) continue;
    const ir::Word* offset = firstWord(*block, "D");
    const double* number = offset == nullptr ? nullptr : ir::constantValue(offset->value);
    const Machining now = within(*block, i, *facts[i]);
    const char* name = codeWord(*block, 'G', 41) != nullptr ? "G41" : "G42";
    if (offset == nullptr && firstWord(*block, "H") == nullptr && facts[i]->offset == Certain::No)
      report.at(code->range,
                "{} has no D, and none was before; the radius is 0 or that of the program before, and the "
                "contour is cut "
                "by the centre of the tool; write D with the number of the offset",
                name);
    else if (number != nullptr && *number == 0)
      report.at(offset->range, "D0 is a radius of 0; the contour is cut by the centre of the tool; write the "
                               "number of the offset, or "
                               "G40 where none is meant");
    else if (now.motion >= 2 && facts[i]->mode(Mode::Compensation).on == Certain::No && axesOf(*block) != 0)
      report.at(code->range,
                "{} begins in the block of an arc; the control stops with alarm 34; begin it in a straight "
                "move before",
                name);
    else if (axesOf(*block) == 0 && facts[i]->mode(Mode::Compensation).on == Certain::No)
      checkFirstMove(nc, i, *code, name, report);
  }
}

} // namespace

DOTEK_LINT_RULE(compensation_start){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
