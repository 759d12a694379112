#include "lint/NcProgram.h"
#include "lint/Probing.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* store = std::get_if<ir::Store>(&statement.node);
    if (store == nullptr) continue;
    const auto* source = std::get_if<ir::MachineVariable>(&store->value->node);
    if (source == nullptr || !ir::equal(source->number, store->number)) continue;
    const auto number = storedNumber(statement);
    report.at(statement.origin.range(),
              "{} gets its own value, so the block does nothing; one of the two numbers is a "
              "misprint",
              number ? "#" + std::to_string(*number) : "the variable");
  }
}

} // namespace

DOTEK_LINT_RULE(assigned_to_itself){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
