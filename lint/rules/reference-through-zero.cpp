#include "lint/NcProgram.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const auto& facts = nc.machining();
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&nc.program.body[i].node);
    if (block == nullptr || !facts[i]) continue;
    const ir::Word* code = codeWord(*block, 'G', 28);
    if (code == nullptr) code = codeWord(*block, 'G', 30);
    const ir::Word* z = firstWord(*block, "Z");
    const double* value = z == nullptr ? nullptr : ir::constantValue(z->value);
    if (code == nullptr || value == nullptr || *value > 0 || within(*block, i, *facts[i]).distance != 90)
      continue;
    report.at(z->range,
              "in G90 the way to the reference point leads over Z{} of the part, at rapid; the tool goes "
              "into the part; "
              "write G91 into the block, and G90 after it",
              *value);
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(reference_through_zero){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
