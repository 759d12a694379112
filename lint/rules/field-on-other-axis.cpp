#include "lint/PathCommands.h"
#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

struct Axes {
  std::set<std::string> level, height; // fields in X and Y of the path, and in Z
};

Axes axesOf(const gibbs::Cycle& cycle) {
  Axes out;
  const std::set<std::string> fields = fieldsOf(cycle);
  for (const PathCommand& path : pathCommands(*cycle.toolPath))
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (path.axes[axis] != nullptr)
        for (const std::string& name : readsOf(*path.axes[axis]))
          if (fields.contains(name)) (axis == 2 ? out.height : out.level).insert(name);
  return out;
}

void check(const Project& project, Report& report) {
  for (const Joined& joined : project.joined) {
    const gibbs::Cycle& cycle = *joined.cycle;
    if (!cycle.toolPath || cycle.toolPath->hasErrorNodes) continue;
    const Axes axes = axesOf(cycle);
    for (const compost::BranchRef& branch : compost::branchesOf(*joined.prog, cycle.name)) {
      for (const ProgBlock& block : blocksOf(branch.body(), *joined.prog, project)) {
        for (const ProgWord& word : wordsOf(block, nullptr)) {
          if (word.hole == nullptr || word.hole->field.empty()) continue;
          const std::string field = gibbs::foldCase(word.hole->field);
          const bool height = axes.height.contains(field) && !axes.level.contains(field);
          const bool level = axes.level.contains(field) && !axes.height.contains(field);
          if (!(height && (word.address == 'X' || word.address == 'Y')) && !(level && word.address == 'Z'))
            continue;
          report.at(
              word.hole->range,
              "`{}` is {} in the path of `{}`, and the post prints it after {}; the machine goes elsewhere "
              "than the simulation shows; write the address that is meant",
              word.hole->field, height ? "a height" : "a place in X or Y", cycle.name, word.address);
        }
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(field_on_other_axis){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
