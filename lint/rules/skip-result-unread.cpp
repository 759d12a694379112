#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

struct Skip {
  const ir::ProgramStatement* statement = nullptr;
  bool read = false;
};

void checkProgram(const ir::Program& program, Report& report) {
  std::vector<Skip> skips;
  for (const ir::ProgramStatement& statement : program.body) {
    // Where the order of running is another one, nothing is known.
    if (std::holds_alternative<ir::JumpTo>(statement.node)) return;
    bool computed = false;
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
      const auto* variable = std::get_if<ir::MachineVariable>(&store->value->node);
      computed = variable != nullptr && !variableNumber(*store->value);
    }
    eachRead(statement, [&](std::uint32_t number, SourceRange) {
      if (contactAxis(number) && !skips.empty()) skips.back().read = true;
    });
    if (computed && !skips.empty()) skips.back().read = true;
    if (skipOf(statement) != nullptr) skips.push_back({&statement, false});
  }
  if (std::none_of(skips.begin(), skips.end(), [](const Skip& skip) { return skip.read; })) return;
  for (const Skip& skip : skips)
    if (!skip.read)
      report.at(skip.statement->origin.range(),
                "nothing reads where this G31 stopped, #5061 to #5063, before the next one, as after the "
                "others; an "
                "early contact is not noticed; read it, or write G1 if a plain move is meant");
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc.program, report);
}

} // namespace

DOTEK_LINT_RULE(skip_result_unread){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
