#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <array>
#include <map>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastLocal = 33;
constexpr std::uint32_t kFirstSystem = 1000;

// #[2200+#20]: no tool or axis leads from there to a local.
bool isAmongSystem(const ir::ExpressionPtr& number) {
  return ir::firstNumber(number).value_or(0) >= kFirstSystem;
}

void check(const NcProgram& nc, Report& report) {
  std::array<bool, kLastLocal + 1> read{};
  std::map<std::uint32_t, SourceRange> stored;
  for (const std::size_t at : nc.computedReads()) {
    bool computed = false;
    ir::eachNode(nc.program.body[at], [&](const ir::Expression& node) {
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      computed =
          computed || (variable != nullptr && !variableNumber(node) && !isAmongSystem(variable->number));
    });
    if (computed) return; // it may be any
  }
  for (const VariableRead& one : nc.reads())
    if (one.number <= kLastLocal) read[one.number] = true;
  for (const ir::ProgramStatement& statement : nc.program.body) {
    const ir::Call* call = callOf(statement);
    if (call != nullptr && call->kind != ir::CallKind::Macro) return; // a subprogram has the same locals
    if (const auto* store = std::get_if<ir::Store>(&statement.node);
        store != nullptr && !storedNumber(statement) && !isAmongSystem(store->number))
      return;
    if (const auto number = storedNumber(statement); number && *number >= 1 && *number <= kLastLocal)
      stored.emplace(*number, statement.origin.range());
  }
  for (const auto& [number, range] : stored)
    if (!read[number])
      report.at(
          range,
          "#{} gets a value here, and the program never reads it; a local is gone when the program ends; "
          "one of the two numbers is a misprint, or the block is left over",
          number);
}

} // namespace

DOTEK_LINT_RULE(local_never_read){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
