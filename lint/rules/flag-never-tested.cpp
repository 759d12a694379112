#include "ir/Walk.h"
#include "lint/NcProgram.h"

#include <map>
#include <optional>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirst = 100, kLast = 149; // gone at power off: nobody looks at them tomorrow

struct Flag {
  SourceRange first, raised; // set at first, and set to something else
  std::optional<double> value;
  bool constant = true;
};

void check(const Project& project, Report& report) {
  std::set<std::uint32_t> read;
  bool computed = false;
  for (const auto& nc : programsOf(project)) {
    for (const VariableRead& one : nc->reads())
      read.insert(one.number);
    computed = computed || !nc->computedReads().empty();
    for (const ir::ProgramStatement& statement : nc->program.body) {
      if (const auto* print = std::get_if<ir::Print>(&statement.node))
        for (const auto& piece : print->pieces)
          if (piece.number) read.insert(*piece.number);
    }
  }
  if (computed) return;
  for (const auto& nc : programsOf(project)) {
    // Whoever calls a macro may ask for what it leaves.
    const ir::Program& program = nc->program;
    if (!endsProgram(program)) continue;
    std::map<std::uint32_t, Flag> flags;
    for (std::size_t i = 0; i < program.body.size(); ++i) {
      const ir::ProgramStatement& statement = program.body[i];
      const auto* store = std::get_if<ir::Store>(&statement.node);
      const auto number = store == nullptr ? std::nullopt : storedNumber(statement);
      if (!number || *number < kFirst || *number > kLast || read.contains(*number)) continue;
      const double* value = ir::constantValue(store->value);
      Flag& flag = flags[*number];
      flag.constant = flag.constant && value != nullptr;
      if (value == nullptr) continue;
      if (!flag.value) {
        flag.value = *value;
        flag.first = statement.origin.range();
      } else if (*value != *flag.value && !flag.raised.hasPlace() && i > 0 &&
                 std::holds_alternative<ir::Branch>(program.body[i - 1].node) &&
                 program.body[i - 1].origin.range().begin == statement.origin.range().begin) { // IF[..]THEN
        flag.raised = statement.origin.range();
      }
    }
    for (const auto& [number, flag] : flags) {
      if (!flag.constant || !flag.raised.hasPlace()) continue;
      report
          .at(flag.raised,
              "#{} is set here to say that something happened, and no condition asks for it; the program "
              "goes "
              "on as if it had not; test it: `IF[#{} EQ ..]GOTO10`",
              number, number)
          .note(flag.first, "what it is before");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(flag_never_tested){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
