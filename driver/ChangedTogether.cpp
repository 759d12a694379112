#include "driver/ChangedTogether.h"

#include "driver/ChangedFiles.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace dotek::driver {
namespace {

namespace fs = std::filesystem;
namespace gibbs = frontend::gibbs;

std::vector<FileId> filesOf(const gibbs::Cycle& cycle) {
  std::vector<FileId> out;
  if (cycle.defineData) out.push_back(cycle.defineData->file);
  if (cycle.dialog) out.push_back(cycle.dialog->file);
  if (cycle.cycleData) out.push_back(cycle.cycleData->file);
  if (cycle.toolPath) out.push_back(cycle.toolPath->file);
  for (const gibbs::Macro* one : cycle.others)
    out.push_back(one->file);
  for (const gibbs::Dialog* one : cycle.otherDialogs)
    out.push_back(one->file);
  return out;
}

// What is left of a deleted file: its folder.
class Deleted {
public:
  explicit Deleted(const std::set<std::string>& changed) {
    std::error_code error;
    for (const std::string& name : changed)
      if (!fs::exists(name, error) && !error) folders_.insert(fs::path(name).parent_path().string());
  }
  bool any() const { return !folders_.empty(); }
  bool in(const std::string& folder) const {
    return !folders_.empty() && folders_.contains(nameAmongChanged(folder));
  }

private:
  std::set<std::string> folders_;
};

} // namespace

ChangedTogether::ChangedTogether(const std::deque<lint::Project>& projects,
                                 const std::set<std::string>& changed,
                                 const std::function<bool(FileId)>& isChanged) {
  const Deleted deleted(changed);
  for (const lint::Project& project : projects) {
    const bool postChanged =
        deleted.any() || std::any_of(project.progs.begin(), project.progs.end(),
                                     [&](const auto* prog) { return isChanged(prog->file); });
    std::set<const gibbs::Cycle*> withPost;
    for (const lint::Joined& one : project.joined)
      withPost.insert(one.cycle);
    std::set<const gibbs::Cycle*> changedCycles;
    for (const gibbs::Cycle* cycle : project.cycles) {
      const std::vector<FileId> files = filesOf(*cycle);
      const bool here = deleted.in(cycle->folder) || std::any_of(files.begin(), files.end(), isChanged);
      if (here) changedCycles.insert(cycle);
      if (here || (postChanged && !withPost.contains(cycle))) joined_.insert(files.begin(), files.end());
    }
    for (const lint::Joined& one : project.joined) {
      if (changedCycles.contains(one.cycle)) joined_.insert(one.prog->file);
      if (!isChanged(one.prog->file)) continue;
      const std::vector<FileId> files = filesOf(*one.cycle);
      joined_.insert(files.begin(), files.end());
    }
    const auto programChanged = [&](const lint::NcFile& nc) { return isChanged(nc.file->file); };
    if (deleted.any() || std::any_of(project.programs.begin(), project.programs.end(), programChanged))
      for (const lint::NcFile& nc : project.programs)
        programs_.insert(nc.file->file);
  }
}

bool ChangedTogether::covers(std::string_view code, FileId file) const {
  const lint::NamedRule* const rule = lint::findRule(code);
  if (rule == nullptr) return false;
  const lint::Tier tier = rule->rule->tier;
  if (tier == lint::Tier::Bundle) return joined_.contains(file) || programs_.contains(file);
  return tier == lint::Tier::Ir && joined_.contains(file);
}

} // namespace dotek::driver
