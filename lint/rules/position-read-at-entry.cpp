#include "ir/Dataflow.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"
#include "stdlib/ReadAhead.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

// Where the axes are: #5021 to #5023, #5041 to #5043. #5001 and following hold the end of the block before,
// which is known when it is read.
bool isPosition(std::uint32_t number) {
  return number > 5020 && number <= 5043 && number % 20 >= 1 && number % 20 <= 3;
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  // In a main program nothing moves before.
  if (endsProgram(program)) return;
  const auto& body = program.body;
  const auto reads = nc.reads();
  if (std::none_of(reads.begin(), reads.end(),
                   [](const VariableRead& one) { return isPosition(one.number); }))
    return;
  // A dwell, G31, G53 or an M code ends the reading ahead; a move of the program's own is reported elsewhere.
  const auto waited = ir::factsBefore<bool>(
      body, nc.flow(), false,
      [&](std::size_t at, std::size_t, bool before) {
        const auto* block = std::get_if<ir::NcBlock>(&body[at].node);
        if (callOf(body[at]) != nullptr) return true;
        return before || (block != nullptr &&
                          (hasCode(*block, 'G', 4) || hasCode(*block, 'G', 31) || hasCode(*block, 'G', 53) ||
                           hasCode(*block, 'G', 103) || // Haas: limits the reading ahead
                           hasWord(*block, 'M') || axesOf(*block) != 0));
      },
      [](bool& into, bool other) {
        const bool changed = into && !other;
        into = into && other;
        return changed;
      });
  const stdlib::Control* const control = nc.project.control;
  const std::string advice = control != nullptr ? stdlib::waitAdvice(*control) : "`G53`"; // waits on all
  std::set<std::uint32_t> told;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!waited[i] || *waited[i]) continue;
    for (const auto& [number, range] : nc.reads(i)) {
      if (!isPosition(number) || !told.insert(number).second) continue;
      report.at(range.hasPlace() ? range : body[i].origin.range(),
                "#{} is read before anything in this macro waits for the axes; the caller's last move may "
                "still run, "
                "and the control gives a position on the path; put {} before",
                number, advice);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(position_read_at_entry){
    .severity = Severity::Note,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
