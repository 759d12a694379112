#include "lint/MacroNames.h"
#include "lint/ProgBlocks.h"

#include <map>

namespace dotek::lint::rule {
namespace {

// Fields that the branch prints as the work offset of a measurement.
std::set<std::string> offsetFields(const Joined& joined, const Project& project) {
  std::set<std::string> out;
  for (const compost::BranchRef& branch : compost::branchesOf(*joined.prog, joined.cycle->name)) {
    for (const ProgBlock& block : blocksOf(branch.body(), *joined.prog, project)) {
      const std::vector<ProgWord> words = wordsOf(block, nullptr);
      const std::uint32_t program = macroCalled(words);
      const MacroMeaning meaning = meaningOf(project, program);
      if (!meaning.measures()) continue;
      for (const ProgWord& word : words) {
        if (word.hole == nullptr || word.hole->field.empty()) continue;
        const stdlib::MacroArgument* argument = meaning.set->of(program).front()->find(word.address);
        if (argument != nullptr && argument->role == stdlib::ArgumentRole::System)
          out.insert(gibbs::foldCase(word.hole->field));
      }
    }
  }
  return out;
}

struct Bounds {
  const gibbs::Comparison* low = nullptr;
  const gibbs::Comparison* high = nullptr;
  bool other = false;
};

void check(const Project& project, Report& report) {
  std::set<const gibbs::Cycle*> done;
  for (const Joined& joined : project.joined) {
    const gibbs::Cycle& cycle = *joined.cycle;
    if (!cycle.cycleData || cycle.cycleData->hasErrorNodes || !done.insert(&cycle).second) continue;
    for (const std::string& field : offsetFields(joined, project)) {
      Bounds bounds;
      eachStatement(*cycle.cycleData, [&](const gibbs::Statement& statement) {
        const auto* branch = std::get_if<gibbs::If>(&statement.node);
        if (branch == nullptr) return;
        const gibbs::Comparison* only = onlyComparison(statement);
        for (const gibbs::Comparison& comparison : branch->condition.comparisons) {
          const gibbs::Name* name = comparison.left ? plainName(*comparison.left) : nullptr;
          if (name == nullptr || gibbs::foldCase(name->text) != field) continue;
          switch (comparison.relation) {
          case gibbs::Relation::Less:
          case gibbs::Relation::LessEqual: bounds.low = &comparison; break;
          case gibbs::Relation::Greater:
          case gibbs::Relation::GreaterEqual: bounds.high = &comparison; break;
          default: bounds.other = true;
          }
        }
        bounds.other = bounds.other || (only == nullptr && branch->condition.comparisons.size() > 2);
      });
      if (bounds.other || (bounds.low == nullptr) == (bounds.high == nullptr)) continue;
      report.at(
          (bounds.low != nullptr ? bounds.low : bounds.high)->range,
          "`{}` is printed as the number of a work offset, and only {} is checked; a number beyond the other "
          "end of the range stops the machine or sets another offset; check both ends",
          field, bounds.low != nullptr ? "whether it is too small" : "whether it is too large");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(offset_bound_missing){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
