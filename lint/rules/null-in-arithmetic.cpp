#include "ir/NumberSet.h"
#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastLocal = 33;
// Locals that no letter of argument specification I sets.
constexpr std::array<std::uint32_t, 12> kWithoutLetter = {10, 12, 14, 15, 16, 27, 28, 29, 30, 31, 32, 33};

bool returns(const ir::Program& program) {
  return std::any_of(program.body.begin(), program.body.end(),
                     [](const ir::ProgramStatement& s) { return std::holds_alternative<ir::Exit>(s.node); });
}

// A computed number may write any variable.
bool storesAnywhere(const ir::Program& program) {
  return std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& statement) {
    return std::holds_alternative<ir::Store>(statement.node) && !storedNumber(statement);
  });
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  if (storesAnywhere(program)) return;
  const bool main = endsProgram(program) && !returns(program);
  // A macro gets arguments: only the locals that no letter sets are known to be empty. Its argument sets of
  // I, J and K reach them, too, so some statement has to show that the macro takes the local for its own.
  std::set<std::uint32_t> own;
  for (const ir::ProgramStatement& statement : program.body)
    if (const auto number = storedNumber(statement)) own.insert(*number);
  const auto known = [&](std::uint32_t number) {
    if (number == 0 || number > kLastLocal) return false;
    if (main) return true;
    return std::find(kWithoutLetter.begin(), kWithoutLetter.end(), number) != kWithoutLetter.end() &&
           own.contains(number);
  };
  const auto set = ir::factsBefore<ir::NumberSet>(
      program.body, nc.flow(), {},
      [&](std::size_t at, std::size_t, ir::NumberSet variables) {
        const auto number = storedNumber(program.body[at]);
        if (number && *number <= kLastLocal) variables.insert(*number);
        const auto* call = std::get_if<ir::Call>(&program.body[at].node);
        // A subprogram shares the locals of its caller.
        if (call != nullptr && call->kind == ir::CallKind::Subprogram)
          for (std::uint32_t n = 1; n <= kLastLocal; ++n)
            variables.insert(n);
        return variables;
      },
      [](ir::NumberSet& into, const ir::NumberSet& other) { return into.unite(other); });
  std::set<std::uint32_t> told;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    if (!set[i]) continue;
    ir::eachNode(program.body[i], [&](const ir::Expression& node) {
      const auto* unary = std::get_if<ir::Unary>(&node.node);
      if (unary == nullptr || unary->op != ir::UnaryOp::NullAsZero) return;
      const auto number = variableNumber(*unary->operand);
      if (!number || !known(*number) || set[i]->contains(*number) || !told.insert(*number).second) return;
      report.at(
          unary->operand->range.hasPlace() ? unary->operand->range : program.body[i].origin.range(),
          "#{} is empty here, nothing before sets it, and a calculation takes it as 0 without an alarm; set "
          "it, or read the variable that is meant",
          *number);
    });
  }
}

} // namespace

DOTEK_LINT_RULE(null_in_arithmetic){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
