#include "ir/Fold.h"
#include "lint/Project.h"
#include "project/Compilation.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace dotek::lint {
namespace {

void takeLowered(Joined& joined, std::optional<dotek::project::LoweredCycle> lowered) {
  if (!lowered) return;
  // As convert writes it: what flags fix is no argument.
  if (!lowered->fixed.empty()) ir::fold(lowered->cycle, lowered->fixed);
  joined.checksLowered = lowered->checked;
  joined.lowered = std::make_shared<const ir::Cycle>(std::move(lowered->cycle));
}

// The folders above a file or folder, the nearest first, the last of them empty.
std::vector<std::string> foldersAbove(const std::string& name) {
  std::vector<std::string> out;
  std::filesystem::path at = std::filesystem::path(name).lexically_normal();
  if (!at.has_filename()) at = at.parent_path();
  for (std::filesystem::path above = at.parent_path(); above != at; at = above, above = at.parent_path())
    out.push_back(above.string());
  if (out.empty() || !out.back().empty()) out.emplace_back();
  return out;
}

// What lies nearest to a file, by the folder that both are in: where the files of several shops or machines
// are beside one another, a Prog goes with the cycles of its own folder.
class Nearest {
public:
  void add(const std::string& name, const std::vector<std::string>& folders, std::size_t index) {
    for (const std::string& folder : folders)
      below_[{name, folder}].push_back(index);
  }
  std::vector<std::size_t> to(const std::string& name, const std::vector<std::string>& folders) const {
    for (const std::string& folder : folders)
      if (const auto found = below_.find({name, folder}); found != below_.end()) return found->second;
    return {};
  }

private:
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> below_; // by name and folder
};

template <class Tree> void addOnce(std::vector<const Tree*>& out, std::set<FileId>& files, const Tree& tree) {
  if (files.insert(tree.file).second) out.push_back(&tree);
}

} // namespace

void join(Project& project, dotek::project::Compilation& compilation, bool lower) {
  const SourceMap& sources = compilation.session().sources();
  const auto& folders = compilation.folders();
  const auto& progs = compilation.progs();
  const std::set<const gibbs::Cycle*> ownCycles(project.cycles.begin(), project.cycles.end());
  const std::set<const compost::Program*> ownProgs(project.progs.begin(), project.progs.end());
  Nearest nearFolders, nearProgs;
  std::vector<std::vector<std::string>> above(folders.size());
  for (std::size_t i = 0; i < folders.size(); ++i) {
    if (!folders[i].cycle || !ownCycles.contains(folders[i].cycle.get())) continue;
    // What its macros come to without any Prog: for the findings alone.
    compilation.lower(folders[i], dotek::project::Strictness::Lenient);
    above[i] = foldersAbove(sources.file(folders[i].place).name());
    nearFolders.add(folders[i].cycle->name, above[i], i);
  }
  // Nearest seen from either side: a cycle whose own folder has no Prog goes with another's.
  std::vector<std::set<std::size_t>> pairs(progs.size());
  for (std::size_t i = 0; i < progs.size(); ++i) {
    if (!ownProgs.contains(progs[i].get())) continue;
    const auto names = foldersAbove(sources.file(progs[i]->file).name());
    for (const std::string& id : compost::cycleIds(*progs[i])) {
      nearProgs.add(id, names, i);
      const std::vector<std::size_t> near = nearFolders.to(id, names);
      pairs[i].insert(near.begin(), near.end());
    }
  }
  for (std::size_t i = 0; i < folders.size(); ++i)
    if (!above[i].empty())
      for (const std::size_t prog : nearProgs.to(folders[i].cycle->name, above[i]))
        pairs[prog].insert(i);
  for (std::size_t i = 0; i < progs.size(); ++i) {
    for (const std::size_t at : pairs[i]) {
      Joined joined;
      joined.cycle = folders[at].cycle.get();
      joined.prog = progs[i].get();
      const auto routines =
          compost::printingRoutines(*progs[i], project.compostKeywords, folders[at].cycle->name);
      if (routines.size() == 1) joined.routine = routines.front();
      if (joined.routine != nullptr && lower)
        takeLowered(joined, compilation.lower(folders[at], progs[i], *joined.routine,
                                              dotek::project::Strictness::Lenient));
      project.joined.push_back(std::move(joined));
    }
  }
}

std::vector<const gibbs::Macro*> Project::allMacros() const {
  std::vector<const gibbs::Macro*> out;
  std::set<FileId> files; // one may be an input of its own and be called by a cycle
  for (const gibbs::Cycle* cycle : cycles) {
    if (cycle->cycleData) addOnce(out, files, *cycle->cycleData);
    if (cycle->toolPath) addOnce(out, files, *cycle->toolPath);
    for (const gibbs::Macro* other : cycle->others)
      addOnce(out, files, *other);
  }
  for (const gibbs::Macro* macro : macros)
    addOnce(out, files, *macro);
  return out;
}

std::vector<const gibbs::Dialog*> Project::allDialogs() const {
  std::vector<const gibbs::Dialog*> out;
  std::set<FileId> files;
  for (const gibbs::Cycle* cycle : cycles) {
    if (cycle->dialog) addOnce(out, files, *cycle->dialog);
    for (const gibbs::Dialog* other : cycle->otherDialogs)
      addOnce(out, files, *other);
  }
  for (const gibbs::Dialog* dialog : dialogs)
    addOnce(out, files, *dialog);
  return out;
}

} // namespace dotek::lint
