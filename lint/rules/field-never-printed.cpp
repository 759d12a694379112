#include "frontend/gibbs/Walk.h"
#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

// Fields that the macros use to compute or choose something else for the post: another field, or the field's
// own statement.
std::set<std::string> usedForFields(const gibbs::Cycle& cycle, const std::set<std::string>& fields) {
  std::set<std::string> out;
  for (const gibbs::Macro* macro : macrosOf(cycle)) {
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      if (const auto* assign = std::get_if<gibbs::Assignment>(&statement.node)) {
        if (!fields.contains(gibbs::foldCase(assign->target.name.text)) || !assign->value) return;
        out.merge(readsOf(*assign->value));
      } else if (const auto* branch = std::get_if<gibbs::If>(&statement.node)) {
        const auto* then = branch->then ? std::get_if<gibbs::Assignment>(&branch->then->node) : nullptr;
        if (then == nullptr || !fields.contains(gibbs::foldCase(then->target.name.text))) return;
        gibbs::ownExpressions(statement, [&](const gibbs::Expression& e) { out.merge(readsOf(e)); });
      }
    });
  }
  return out;
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (!cycle->defineData || cycle->defineData->hasErrorNodes) continue;
    std::set<std::string> printed;
    const compost::BranchRef* shown = nullptr;
    std::vector<compost::BranchRef> branches;
    for (const Joined& joined : project.joined) {
      if (joined.cycle != cycle) continue;
      for (const compost::BranchRef& branch : compost::branchesOf(*joined.prog, cycle->name)) {
        if (!compost::fieldsPrinted(*joined.prog, branch, cycle->name).empty()) branches.push_back(branch);
      }
      // Blocks outside the branches are printed for this cycle, too.
      for (const compost::Item& item : joined.prog->items) {
        const auto* routine = std::get_if<compost::Routine>(&item);
        if (routine == nullptr) continue;
        for (const compost::FieldRef& field : compost::fieldsPrinted(*joined.prog, *routine, cycle->name))
          printed.insert(gibbs::foldCase(field.name));
      }
    }
    // A post that prints no field at all is no post of this cycle.
    if (branches.empty()) continue;
    shown = &branches.front();
    const std::set<std::string> used = usedForFields(*cycle, fieldsOf(*cycle));
    for (const gibbs::Definition& definition : cycle->defineData->definitions) {
      const std::string key = gibbs::foldCase(definition.name.text);
      if (printed.contains(key) || used.contains(key) || project.gibbsKeywords.isReservedField(key)) continue;
      report
          .at(definition.name.range,
              "no branch of the post prints `{}`; what the user types there does not reach the machine; "
              "print it, or "
              "take the field out",
              definition.name.text)
          .note(shown->branch->ifRange, "the branch for this cycle");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(field_never_printed){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
