#include "ir/Flow.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

// M30, M2, M99, or a code that is computed.
bool endsNormally(const ir::ProgramStatement& statement) {
  if (std::holds_alternative<ir::Exit>(statement.node) || std::holds_alternative<ir::JumpTo>(statement.node))
    return true;
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return endsProgram(statement) ||
         (block != nullptr && std::any_of(block->words.begin(), block->words.end(), [](const ir::Word& word) {
            return word.address == 'M' && ir::constantValue(word.value) == nullptr;
          }));
}

void check(const Project& project, Report& report) {
  eachProgram(project, [&](const ir::Program& program, const macrob::File& file) {
    if (program.nameKind == ir::Program::NameKind::None || program.body.empty()) return;
    const auto& body = program.body;
    const auto next = ir::successors(body);
    const std::vector<bool> reached = ir::reachable(body);
    bool ends = false;
    bool alarms = false;
    const ir::ProgramStatement* past = nullptr;
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (!reached[i]) continue;
      ends = ends || endsNormally(body[i]);
      alarms = alarms || std::holds_alternative<ir::Raise>(body[i].node);
      if (!endsNormally(body[i]) && std::find(next[i].begin(), next[i].end(), body.size()) != next[i].end())
        past = &body[i];
    }
    if (past != nullptr && (ends || alarms || file.markLast))
      report.at(
          past->origin.range(),
          "the program goes on past its last block; the control stops with an alarm, or begins again from "
          "the top; end it with M30, a macro with M99");
    else if (!ends && alarms)
      report.at(
          program.range,
          "each way through the program ends in an alarm, none in M30 or M99; the end before the alarms is "
          "missing; write it");
  });
}

} // namespace

DOTEK_LINT_RULE(no_normal_end){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .explanation =
        "Behind the last block of the good way stand the blocks of the alarms. Where its M30 or M99 is lost, "
        "the program runs into them, or out of the file.",
    .check = check,
};

} // namespace dotek::lint::rule
