#include "lint/NcProgram.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const auto& facts = nc.machining();
  const auto& body = nc.program.body;
  int first = -1;                   // tool that the program begins with
  const ir::Word* called = nullptr; // by T, and not put in
  bool cuts = false;                // something feeds after it
  for (std::size_t i = 0; i < facts.size(); ++i) {
    // What a called program changes is not known.
    if (callOf(body[i]) != nullptr) return;
    const auto* block = std::get_if<ir::NcBlock>(&body[i].node);
    if (block == nullptr || !facts[i]) continue;
    const ir::Word* tool = firstWord(*block, "T");
    if (tool != nullptr) {
      const double* number = ir::constantValue(tool->value);
      if (number == nullptr) return;
      const bool again = first >= 0 && *number == first;
      if (first < 0) first = static_cast<int>(*number);
      // The first tool is fetched again for the next part.
      called = *number > 0 && !again ? tool : nullptr;
      cuts = false;
    }
    if (codeWord(*block, 'M', 6) != nullptr) called = nullptr;
    const Machining now = within(*block, i, *facts[i]);
    const bool starts = codeWord(*block, 'M', 3) != nullptr || codeWord(*block, 'M', 4) != nullptr ||
                        codeWord(*block, 'G', 43) != nullptr;
    cuts = cuts ||
           (called != nullptr && tool == nullptr && starts && now.tool != *ir::constantValue(called->value));
  }
  if (called == nullptr || !cuts) return;
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
