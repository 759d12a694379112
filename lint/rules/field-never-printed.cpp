#include "frontend/gibbs/Walk.h"
#include "lint/CalledFiles.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <vector>

namespace dotek::lint::rule {
namespace {

// What the macros before the path do with a field beside keeping it.
struct Uses {
  std::set<std::string> computes; // comes into another field, or decides on one, through other variables too
  std::set<std::string> bounds;   // comes into a comparison or a call of a check together with another field
};

// What the macro that is called takes, where the folder holds it.
const gibbs::Args* argsOf(const gibbs::CallMacro& call, const gibbs::Cycle& cycle, const Project& project) {
  const gibbs::Macro* macro = calledMacro(cycle, call, project);
  const gibbs::Args* out = nullptr;
  if (macro != nullptr)
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      if (const auto* args = std::get_if<gibbs::Args>(&statement.node)) out = args;
    });
  return out;
}

Uses usesOf(const gibbs::Cycle& cycle, const Project& project) {
  const std::set<std::string> fields = fieldsOf(cycle);
  using Sources = std::map<std::string, std::set<std::string>>;
  Sources values; // of a variable: what it is computed from
  Sources from;   // and what decides on its value
  std::vector<std::set<std::string>> conditions;
  Uses out;
  for (const gibbs::Macro* macro : macrosOf(cycle)) {
    if (cycle.toolPath && macro == &*cycle.toolPath) continue;
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      if (const auto* assign = std::get_if<gibbs::Assignment>(&statement.node)) {
        if (!assign->value) return;
        const std::set<std::string> reads = readsOf(*assign->value);
        const std::string target = gibbs::foldCase(assign->target.name.text);
        values[target].insert(reads.begin(), reads.end());
        from[target].insert(reads.begin(), reads.end());
      } else if (const auto* branch = std::get_if<gibbs::If>(&statement.node)) {
        std::set<std::string> reads;
        gibbs::ownExpressions(statement, [&](const gibbs::Expression& e) { reads.merge(readsOf(e)); });
        const auto* then = branch->then ? std::get_if<gibbs::Assignment>(&branch->then->node) : nullptr;
        if (then != nullptr) from[gibbs::foldCase(then->target.name.text)].insert(reads.begin(), reads.end());
        conditions.push_back(std::move(reads));
      } else if (const auto* call = std::get_if<gibbs::CallMacro>(&statement.node)) {
        const gibbs::Args* takes = argsOf(*call, cycle, project);
        for (std::size_t i = 0; takes != nullptr && i < call->arguments.size() && i < takes->names.size();
             ++i)
          if (call->arguments[i]) {
            const std::set<std::string> given = readsOf(*call->arguments[i]);
            const std::string target = gibbs::foldCase(takes->names[i].name.text);
            values[target].insert(given.begin(), given.end());
            from[target].insert(given.begin(), given.end());
          }
        std::set<std::string> reads;
        gibbs::ownExpressions(statement, [&](const gibbs::Expression& e) { reads.merge(readsOf(e)); });
        conditions.push_back(std::move(reads));
      }
    });
  }
  const auto spread = [](const Sources& all, std::set<std::string>& names) {
    std::vector<std::string> open(names.begin(), names.end());
    while (!open.empty()) {
      const auto sources = all.find(open.back());
      open.pop_back();
      if (sources == all.end()) continue;
      for (const std::string& name : sources->second)
        if (names.insert(name).second) open.push_back(name);
    }
  };
  for (const auto& [name, sources] : from)
    if (fields.contains(name)) out.computes.insert(sources.begin(), sources.end());
  spread(from, out.computes);
  for (std::set<std::string>& names : conditions) {
    spread(values, names);
    std::set<std::string> compared;
    std::set_intersection(names.begin(), names.end(), fields.begin(), fields.end(),
                          std::inserter(compared, compared.begin()));
    if (compared.size() > 1) out.bounds.merge(compared);
  }
  return out;
}

// Fields that a macro before the path computes and no input of the dialog takes: nobody types them.
std::set<std::string> computedOnly(const gibbs::Cycle& cycle) {
  std::set<std::string> out;
  if (!cycle.dialog || cycle.dialog->hasErrorNodes || !cycle.otherDialogs.empty()) return out;
  for (const gibbs::Macro* macro : macrosOf(cycle)) {
    if (cycle.toolPath && macro == &*cycle.toolPath) continue;
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      if (const auto* assign = std::get_if<gibbs::Assignment>(&statement.node))
        out.insert(gibbs::foldCase(assign->target.name.text));
    });
  }
  for (const gibbs::Control& control : cycle.dialog->controls)
    if (control.variable) out.erase(gibbs::foldCase(control.variable->text));
  return out;
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (!cycle->defineData || cycle->defineData->hasErrorNodes) continue;
    const std::set<std::string> fields = fieldsOf(*cycle);
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
          printed.insert(printedFor(project, fields, field.name));
      }
    }
    // A post that prints no field at all is no post of this cycle.
    if (branches.empty()) continue;
    const std::set<std::string> computed = computedOnly(*cycle);
    shown = &branches.front();
    const Uses uses = usesOf(*cycle, project);
    std::set<std::string> drawn;
    if (cycle->toolPath)
      for (const NameUse& use : namesOf(*cycle->toolPath, project))
        if (use.reads) drawn.insert(use.key);
    for (const gibbs::Definition& definition : cycle->defineData->definitions) {
      const std::string key = gibbs::foldCase(definition.name.text);
      // A length that only bounds other fields has no place in the program; one that the path draws has.
      const bool bound = uses.bounds.contains(key) && !drawn.contains(key);
      if (computed.contains(key) || printed.contains(key) || uses.computes.contains(key) || bound ||
          project.gibbsKeywords.isReservedField(key))
        continue;
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
