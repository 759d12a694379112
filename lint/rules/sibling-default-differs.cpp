#include "frontend/gibbs/Labels.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <map>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLeast = 3; // cycles that agree

struct Default {
  const gibbs::Cycle* cycle = nullptr;
  const gibbs::Definition* definition = nullptr;
};

void check(const Project& project, Report& report) {
  // By name and by what the dialog says of the field.
  std::map<std::pair<std::string, std::string>, std::vector<Default>> all;
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (!cycle->defineData || !cycle->dialog) continue;
    std::map<std::string, std::string> meanings;
    for (const gibbs::InputLabel& label : gibbs::inputLabels(*cycle->dialog))
      meanings.emplace(gibbs::foldCase(label.variable.text), label.meaning);
    for (const gibbs::Definition& definition : cycle->defineData->definitions) {
      const std::string key = gibbs::foldCase(definition.name.text);
      const auto meaning = meanings.find(key);
      if (!definition.number || meaning == meanings.end() || meaning->second.empty()) continue;
      all[{key, meaning->second}].push_back({cycle, &definition});
    }
  }
  for (const auto& [key, defaults] : all) {
    std::map<double, std::size_t> values;
    for (const Default& one : defaults)
      ++values[*one.definition->number];
    if (values.size() != 2) continue;
    const auto& [firstValue, firstCount] = *values.begin();
    const auto& [lastValue, lastCount] = *values.rbegin();
    if (std::min(firstCount, lastCount) != 1 || std::max(firstCount, lastCount) < kLeast) continue;
    const double usual = firstCount > lastCount ? firstValue : lastValue;
    for (const Default& one : defaults) {
      if (*one.definition->number == usual) continue;
      const auto& other = *std::find_if(defaults.begin(), defaults.end(),
                                        [&](const Default& d) { return *d.definition->number == usual; });
      report
          .at(one.definition->valueRange,
              "`{}` begins with another value here than in the {} other cycles whose "
              "dialog says the same of it",
              one.definition->name.text, defaults.size() - 1)
          .note(other.definition->valueRange, "as in this one");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(sibling_default_differs){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
