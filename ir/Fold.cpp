#include "ir/Fold.h"

#include "ir/Propagate.h"
#include "ir/Substitute.h"
#include "ir/Walk.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dotek::ir {
namespace {

// Rounds of removing dead assignments and jumps, each of which may make room for the other.
constexpr int kMostRounds = 8;

// Folds the list; what is known at its end, nothing where no path ends there.
std::optional<Environment> foldList(Cycle& cycle, std::vector<CycleStatement>& list, const Environment& entry,
                                    const FoldOptions& options) {
  if (options.unroll) {
    const auto another = [&](LabelId label) {
      const LabelName name = cycle.labels.at(label);
      return cycle.addLabel(name);
    };
    if (auto run = unroll(list, entry, options.maxSteps, another)) {
      list = std::move(run->statements);
      return std::move(run->atEnd);
    }
  }
  Constants constants = propagate(list, entry);
  list = specialised(list, constants);
  return std::move(constants.atEnd);
}

bool mayFailAssigning(const CycleStatement& statement) {
  const auto* set = std::get_if<Assign>(&statement.node);
  return set && mayFail(set->value);
}

// Variables whose value reaches anything but assignments to variables that are not needed themselves.
std::vector<bool> neededVariables(const Cycle& cycle, const std::set<VariableId>& read) {
  std::vector<bool> needed(cycle.variables.size());
  std::vector<std::vector<VariableId>> sources(cycle.variables.size()); // read to assign each variable
  std::vector<VariableId> open;
  const auto need = [&](VariableId id) {
    if (id >= needed.size() || needed[id]) return;
    needed[id] = true;
    open.push_back(id);
  };
  for (const VariableId id : read)
    need(id);
  for (const auto* list : {&cycle.checks, &cycle.body}) {
    for (const CycleStatement& statement : *list) {
      const auto* set = std::get_if<Assign>(&statement.node);
      const bool stays = !set || set->variable >= needed.size() || mayFailAssigning(statement);
      eachNode(statement, [&](const Expression& node) {
        const auto* use = std::get_if<VariableUse>(&node.node);
        if (!use) return;
        if (stays)
          need(use->variable);
        else
          sources[set->variable].push_back(use->variable);
      });
    }
  }
  while (!open.empty()) {
    const VariableId id = open.back();
    open.pop_back();
    for (const VariableId source : sources[id])
      need(source);
  }
  return needed;
}

bool removeDeadAssignments(Cycle& cycle, const std::set<VariableId>& read) {
  const std::vector<bool> needed = neededVariables(cycle, read);
  bool changed = false;
  for (auto* list : {&cycle.checks, &cycle.body}) {
    changed |=
        std::erase_if(*list, [&](const CycleStatement& statement) {
          const auto* set = std::get_if<Assign>(&statement.node);
          return set && set->variable < needed.size() && !needed[set->variable] && !mayFail(set->value);
        }) > 0;
  }
  return changed;
}

// Jumps to what follows anyway, then labels that nothing jumps to.
bool removeJumps(std::vector<CycleStatement>& list) {
  std::vector<bool> gone(list.size());
  std::set<LabelId> following; // labels between here and the next statement that does something
  std::set<LabelId> targets;
  for (std::size_t i = list.size(); i-- > 0;) {
    const auto jumps = [&](LabelId target, bool mayGo) {
      gone[i] = mayGo && following.contains(target);
      if (gone[i]) return;
      targets.insert(target);
      following.clear();
    };
    match(
        list[i], [&](const Label& node) { following.insert(node.label); },
        [&](const Jump& node) { jumps(node.target, true); },
        [&](const Branch& node) { jumps(node.target, !mayFail(node.condition)); },
        [&](const OneOf<Assign, Store, Return, Move, Measure, CallCycle, ProbePower, Spindle, Coolant,
                        SetMode, Dwell, Stop, Alarm, Comment, OpaqueBlock, Port, Print> auto&) {
          following.clear();
        });
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto* label = std::get_if<Label>(&list[i].node);
    if (label && !targets.contains(label->label)) gone[i] = true;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (gone[i]) continue;
    if (kept != i) list[kept] = std::move(list[i]);
    ++kept;
  }
  const bool changed = kept != list.size();
  list.resize(kept);
  return changed;
}

} // namespace

void fold(Cycle& cycle, const std::map<VariableId, double>& values, const FoldOptions& options) {
  Environment entry(cycle.variables.size());
  for (const auto& [id, value] : values)
    if (id < entry.size()) entry[id] = Scalar::of(value);

  // What the body begins with where the checks have no end: nothing that they assign.
  Environment rest = entry;
  for (const CycleStatement& statement : cycle.checks) {
    const auto* set = std::get_if<Assign>(&statement.node);
    if (set && set->variable < rest.size()) rest[set->variable] = Scalar{};
  }
  const auto afterChecks = foldList(cycle, cycle.checks, entry, options);
  foldList(cycle, cycle.body, afterChecks ? *afterChecks : rest, options);

  for (int round = 0; round < kMostRounds; ++round) {
    bool changed = removeDeadAssignments(cycle, options.read);
    changed |= removeJumps(cycle.checks);
    changed |= removeJumps(cycle.body);
    if (!changed) break;
  }
}

bool uses(const Cycle& cycle, VariableId variable) {
  bool found = false;
  for (const auto* list : {&cycle.checks, &cycle.body}) {
    for (const CycleStatement& statement : *list) {
      const auto* set = std::get_if<Assign>(&statement.node);
      if (set && set->variable == variable) return true;
      eachNode(statement, [&](const Expression& node) {
        const auto* use = std::get_if<VariableUse>(&node.node);
        found |= use && use->variable == variable;
      });
      if (found) return true;
    }
  }
  return false;
}

} // namespace dotek::ir
