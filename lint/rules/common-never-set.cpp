#include "lint/NcProgram.h"

#include <algorithm>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirstCommon = 100;
constexpr std::uint32_t kLastCommon = 999;
constexpr std::size_t kLeast = 3; // variables that the files set themselves

void check(const Project& project, Report& report) {
  std::set<std::uint32_t> stored;
  std::map<std::uint32_t, SourceRange> read;
  bool computed = false; // a number that is computed may be any
  bool main = false;
  for (const auto& nc : programsOf(project)) {
    main = main || endsProgram(nc->program);
    const auto& body = nc->program.body;
    for (std::size_t i = 0; i < body.size(); ++i) {
      const ir::ProgramStatement& statement = body[i];
      const auto number = storedNumber(statement);
      computed = computed || (std::holds_alternative<ir::Store>(statement.node) && !number);
      if (number) stored.insert(*number);
      for (const auto& [one, range] : nc->reads(i))
        read.emplace(one, range.hasPlace() ? range : statement.origin.range());
    }
  }
  const auto isCommon = [](std::uint32_t number) { return number >= kFirstCommon && number <= kLastCommon; };
  if (computed || !main || std::count_if(stored.begin(), stored.end(), isCommon) < static_cast<int>(kLeast))
    return;
  for (const auto& entry : read) {
    const std::uint32_t number = entry.first;
    const SourceRange range = entry.second;
    if (!isCommon(number) || stored.contains(number)) continue;
    const bool result = std::any_of(project.macroSets.begin(), project.macroSets.end(), [&](const auto& set) {
      return std::any_of(set.signatures.begin(), set.signatures.end(), [&](const auto& signature) {
        return std::any_of(signature.results.begin(), signature.results.end(),
                           [&](const auto& one) { return one.variable == number; });
      });
    });
    if (result) continue;
    report.at(range,
              "#{} is read, and no program of these files sets it; if nobody else does, it is empty; write "
              "the number "
              "that is meant, or set it",
              number);
  }
}

} // namespace

DOTEK_LINT_RULE(common_never_set){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
