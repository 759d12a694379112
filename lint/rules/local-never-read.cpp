#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastLocal = 33;

void checkProgram(const ir::Program& program, Report& report) {
  std::set<std::uint32_t> read;
  std::map<std::uint32_t, SourceRange> stored;
  for (const ir::ProgramStatement& statement : program.body) {
    bool computed = false;
    ir::eachNode(statement, [&](const ir::Expression& node) {
      computed =
          computed || (std::holds_alternative<ir::MachineVariable>(node.node) && !variableNumber(node));
    });
    // A number that is computed may be any; a subprogram has the same locals.
    const ir::Call* call = callOf(statement);
    if (computed || (call != nullptr && call->kind != ir::CallKind::Macro)) return;
    if (std::holds_alternative<ir::Store>(statement.node) && !storedNumber(statement)) return;
    eachRead(statement, [&](std::uint32_t number, SourceRange) { read.insert(number); });
    if (const auto number = storedNumber(statement); number && *number >= 1 && *number <= kLastLocal)
      stored.emplace(*number, statement.origin.range());
  }
  for (const auto& [number, range] : stored)
    if (!read.contains(number))
      report.at(
          range,
          "#{} gets a value here, and the program never reads it; a local is gone when the program ends; "
          "one of the two numbers is a misprint, or the block is left over",
          number);
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc.program, report);
}

} // namespace

DOTEK_LINT_RULE(local_never_read){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
