#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/OwnCalls.h"

#include <algorithm>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastArgument = 26;

// `#[2+#27]=..` may set any argument; `#[5221+#1]=..` sets none.
bool storesAnyLocal(const ir::ProgramStatement& statement) {
  const auto* store = std::get_if<ir::Store>(&statement.node);
  if (store == nullptr || ir::constantValue(store->number) != nullptr) return false;
  const auto base = ir::firstNumber(store->number);
  return !base || *base <= kLastArgument;
}

void check(const NcProgram& nc, Report& report) {
  if (endsProgram(nc.program) || requiredLocals(nc.program).size() < 2) return;
  const auto& body = nc.program.body;
  std::set<std::uint32_t> compared;
  std::set<std::uint32_t> stored;
  std::map<std::uint32_t, SourceRange> read;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const ir::ProgramStatement& statement = body[i];
    if (const auto number = storedNumber(statement))
      stored.insert(*number);
    else if (storesAnyLocal(statement))
      return;
    if (const auto* branch = std::get_if<ir::Branch>(&statement.node)) {
      ir::eachNode(branch->condition, [&](const ir::Expression& node) {
        if (const auto number = variableNumber(node)) compared.insert(*number);
      });
      continue;
    }
    if (callOf(statement) != nullptr) continue; // an empty one is handed on as such
    for (const auto& [number, range] : nc.reads(i))
      read.emplace(number, range.hasPlace() ? range : statement.origin.range());
  }
  for (const auto& [number, range] : read)
    if (number >= 1 && number <= kLastArgument && !compared.contains(number) && !stored.contains(number))
      report.at(
          range,
          "the program gives an alarm where other arguments are missing, and does not look at #{}; a call "
          "without it goes on with an empty value, which drops the word or counts as 0; test it, too",
          number);
}

} // namespace

DOTEK_LINT_RULE(argument_not_tested){
    .severity = Severity::Note,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
