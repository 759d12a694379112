#include "frontend/compost/Lower.h"
#include "frontend/gibbs/Lower.h"
#include "ir/InferKinds.h"
#include "lint/Project.h"

#include <algorithm>
#include <map>

namespace dotek::lint {
namespace {

std::shared_ptr<const ir::Cycle> lower(const Project& project, Joined& joined) {
  // What cannot be lowered is told by convert; here it only silences the rules of the IR.
  Diagnostics ignored;
  ir::Cycle cycle = gibbs::declareCycle(*joined.cycle, project.sources);
  std::map<std::string, ir::VariableId> names;
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    names.emplace(gibbs::foldCase(cycle.variable(id).name), id);
  std::map<std::string, ir::VariableId> hosts;
  const auto host = [&](const std::string& name) {
    const auto [at, added] = hosts.try_emplace(name, 0);
    if (added) {
      ir::Variable variable;
      variable.name = name;
      variable.role = ir::Role::Host;
      at->second = cycle.add(std::move(variable));
    }
    return at->second;
  };
  const auto field = [&](const std::string& name, SourceRange where) -> std::optional<ir::VariableId> {
    const auto [at, added] = names.try_emplace(gibbs::foldCase(name), 0);
    if (added) {
      ir::Variable variable;
      variable.name = name;
      variable.role = ir::Role::Parameter;
      variable.range = where;
      at->second = cycle.add(std::move(variable));
    }
    return at->second;
  };
  if (joined.cycle->cycleData && !joined.cycle->cycleData->hasErrorNodes) {
    gibbs::LowerContext context{
        project.sources,
        project.gibbsKeywords,
        project.limits,
        ignored,
        {},
        {},
        [](const std::string&, SourceRange) -> const gibbs::Macro* { return nullptr; },
        [&](const std::string&, SourceRange) -> const gibbs::Dialog* {
          return joined.cycle->dialog ? &*joined.cycle->dialog : nullptr;
        },
        host};
    joined.checksLowered = gibbs::lowerChecks(*joined.cycle->cycleData, cycle, context);
    if (!joined.checksLowered) cycle.checks.clear();
  }
  std::vector<const stdlib::MacroSet*> sets;
  for (const stdlib::MacroSet& set : project.macroSets)
    sets.push_back(&set);
  const compost::LowerSettings settings{
      project.sources,
      *project.form,
      project.limits,
      *project.postControl,
      std::move(sets),
      {},
      field,
      [&](const std::string& name, SourceRange) { return std::optional(host(name)); },
      [](ir::VariableId) -> std::optional<double> { return std::nullopt; }};
  Diagnostics told;
  auto body = compost::lowerRoutine(*joined.prog, *joined.routine, joined.cycle->name, cycle, settings, told);
  if (!body || told.hasErrors()) return nullptr;
  cycle.body = std::move(body->body);
  ir::inferKinds(cycle);
  return std::make_shared<const ir::Cycle>(std::move(cycle));
}

} // namespace

void join(Project& project) {
  for (const compost::Program* prog : project.progs) {
    const std::vector<std::string> ids = compost::cycleIds(*prog);
    for (const gibbs::Cycle* cycle : project.cycles) {
      if (std::find(ids.begin(), ids.end(), cycle->name) == ids.end()) continue;
      Joined joined;
      joined.cycle = cycle;
      joined.prog = prog;
      const auto routines = compost::printingRoutines(*prog, project.compostKeywords, cycle->name);
      if (routines.size() == 1) joined.routine = routines.front();
      if (joined.routine != nullptr && project.form && project.postControl)
        joined.lowered = lower(project, joined);
      project.joined.push_back(std::move(joined));
    }
  }
}

std::vector<const gibbs::Macro*> Project::allMacros() const {
  std::vector<const gibbs::Macro*> out;
  const auto add = [&](const gibbs::Macro& macro) {
    // A file may be an input of its own and be called by a cycle.
    if (std::none_of(out.begin(), out.end(), [&](const gibbs::Macro* m) { return m->file == macro.file; }))
      out.push_back(&macro);
  };
  for (const gibbs::Cycle* cycle : cycles) {
    if (cycle->cycleData) add(*cycle->cycleData);
    if (cycle->toolPath) add(*cycle->toolPath);
    for (const gibbs::Macro* other : cycle->others)
      add(*other);
  }
  for (const gibbs::Macro* macro : macros)
    add(*macro);
  return out;
}

std::vector<const gibbs::Dialog*> Project::allDialogs() const {
  std::vector<const gibbs::Dialog*> out;
  const auto add = [&](const gibbs::Dialog& dialog) {
    if (std::none_of(out.begin(), out.end(), [&](const gibbs::Dialog* d) { return d->file == dialog.file; }))
      out.push_back(&dialog);
  };
  for (const gibbs::Cycle* cycle : cycles) {
    if (cycle->dialog) add(*cycle->dialog);
    for (const gibbs::Dialog* other : cycle->otherDialogs)
      add(*other);
  }
  for (const gibbs::Dialog* dialog : dialogs)
    add(*dialog);
  return out;
}

} // namespace dotek::lint
