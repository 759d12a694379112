#include "lint/NcProgram.h"

#include <set>

namespace dotek::lint::rule {
namespace {

// The first M6 of a program that names no tool at all.
const ir::Word* changeWithoutTool(const NcProgram& nc) {
  const ir::Word* change = nullptr;
  const auto& facts = nc.machining();
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (callOf(nc.program.body[i]) != nullptr) return nullptr;
    const auto* block = std::get_if<ir::NcBlock>(&nc.program.body[i].node);
    if (block == nullptr) continue;
    if (firstWord(*block, "T") != nullptr) return nullptr;
    if (change == nullptr) change = codeWord(*block, 'M', 6);
  }
  return change;
}

void check(const NcProgram& nc, Report& report) {
  if (const ir::Word* change = changeWithoutTool(nc); change != nullptr) {
    report.at(change->range,
              "M6 changes the tool, and the program names none; the spindle gets the tool that was called "
              "last, whatever it is; write T before it");
    return;
  }
  const auto& facts = nc.machining();
  const auto& body = nc.program.body;
  int first = -1;                   // tool that the program begins with
  const ir::Word* called = nullptr; // by T, and not put in
  bool cuts = false;                // something feeds after it
  bool stages = false;              // a tool was fetched during a cut and put in afterwards
  std::set<double> waiting;         // tools so fetched
  for (std::size_t i = 0; i < facts.size(); ++i) {
    // What a called program changes is not known.
    if (callOf(body[i]) != nullptr) return;
    const auto* block = std::get_if<ir::NcBlock>(&body[i].node);
    if (block == nullptr || !facts[i]) continue;
    const ir::Word* tool = firstWord(*block, "T");
    if (tool != nullptr) {
      const double* number = ir::constantValue(tool->value);
      if (number == nullptr || !(*number >= 0 && *number < 1e9)) return;
      const bool changes = codeWord(*block, 'M', 6) != nullptr;
      if (called != nullptr && cuts) waiting.insert(*ir::constantValue(called->value));
      stages = stages || (changes && waiting.contains(*number));
      const bool again = first >= 0 && *number == first;
      if (first < 0) first = static_cast<int>(*number);
      // The first tool is fetched again for the next part.
      called = *number > 0 && !again ? tool : nullptr;
      cuts = false;
    }
    if (codeWord(*block, 'M', 6) != nullptr) {
      stages = stages || (called != nullptr && tool == nullptr && cuts);
      called = nullptr;
    }
    const Machining now = within(*block, i, *facts[i]);
    const bool starts = codeWord(*block, 'M', 3) != nullptr || codeWord(*block, 'M', 4) != nullptr ||
                        codeWord(*block, 'G', 43) != nullptr;
    cuts = cuts ||
           (called != nullptr && tool == nullptr && starts && now.tool != *ir::constantValue(called->value));
  }
  if (called == nullptr || !cuts || stages) return; // the last one is fetched for the next part
  report.at(called->range,
            "`T{}` calls a tool, and no M6 puts it in before the program goes on; the tool before cuts in "
            "its place; "
            "write M6",
            *ir::constantValue(called->value));
}

} // namespace

DOTEK_LINT_RULE(tool_not_changed){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
