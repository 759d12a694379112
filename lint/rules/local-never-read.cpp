#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastLocal = 33;
constexpr std::uint32_t kFirstSystem = 1000;

// #[2200+#20]: no tool or axis leads from there to a local.
bool isAmongSystem(const ir::ExpressionPtr& number) {
  return ir::firstNumber(number).value_or(0) >= kFirstSystem;
}

void checkProgram(const ir::Program& program, Report& report) {
  std::set<std::uint32_t> read;
  std::map<std::uint32_t, SourceRange> stored;
  for (const ir::ProgramStatement& statement : program.body) {
    bool computed = false;
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      computed =
          computed || (variable != nullptr && !variableNumber(node) && !isAmongSystem(variable->number));
    });
    // A number that is computed may be any; a subprogram has the same locals.
    const ir::Call* call = callOf(statement);
    if (computed || (call != nullptr && call->kind != ir::CallKind::Macro)) return;
    if (const auto* store = std::get_if<ir::Store>(&statement.node);
        store != nullptr && !storedNumber(statement) && !isAmongSystem(store->number))
      return;
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
