#include "ir/Fold.h"
#include "lint/Project.h"
#include "project/Compilation.h"

#include <algorithm>

namespace dotek::lint {
namespace {

void takeLowered(Joined& joined, std::optional<dotek::project::LoweredCycle> lowered) {
  if (!lowered) return;
  // As convert writes it: what flags fix is no argument.
  if (!lowered->fixed.empty()) ir::fold(lowered->cycle, lowered->fixed);
  joined.checksLowered = lowered->checked;
  joined.lowered = std::make_shared<const ir::Cycle>(std::move(lowered->cycle));
}

} // namespace

void join(Project& project, dotek::project::Compilation& compilation, bool lower) {
  const auto holds = [](const auto& list, const auto& one) {
    return std::find(list.begin(), list.end(), one) != list.end();
  };
  // What its macros come to without any Prog: for the findings alone.
  for (const dotek::project::CycleFolder& folder : compilation.folders())
    if (folder.cycle && holds(project.cycles, folder.cycle.get()))
      compilation.lower(folder, dotek::project::Strictness::Lenient);
  for (const auto& prog : compilation.progs()) {
    if (!holds(project.progs, prog.get())) continue;
    const std::vector<std::string> ids = compost::cycleIds(*prog);
    for (const dotek::project::CycleFolder& folder : compilation.folders()) {
      if (!folder.cycle || !holds(project.cycles, folder.cycle.get()) || !holds(ids, folder.cycle->name))
        continue;
      Joined joined;
      joined.cycle = folder.cycle.get();
      joined.prog = prog.get();
      const auto routines = compost::printingRoutines(*prog, project.compostKeywords, folder.cycle->name);
      if (routines.size() == 1) joined.routine = routines.front();
      if (joined.routine != nullptr && lower)
        takeLowered(joined,
                    compilation.lower(folder, prog, *joined.routine, dotek::project::Strictness::Lenient));
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
