#include "lint/PathCommands.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

void checkMacro(const gibbs::Macro& macro, Report& report) {
  const std::set<std::string> planes = drillData(macro, "RETRACT_PLANE");
  const std::set<std::string> points = [&] {
    std::set<std::string> out = drillData(macro, "X");
    out.merge(drillData(macro, "Y"));
    return out;
  }();
  const std::vector<PathCommand> paths = pathCommands(macro);
  const auto reads = [](const gibbs::Expression& value, const std::set<std::string>& names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return signOf(value, name) != 0; });
  };
  const auto below = [&](const gibbs::Expression& value) {
    return std::any_of(planes.begin(), planes.end(),
                       [&](const std::string& name) { return signOf(value, name) == -1; });
  };
  std::set<std::string> own;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    if (const auto* assign = std::get_if<gibbs::Assignment>(&statement.node))
      own.insert(gibbs::foldCase(assign->target.name.text));
    if (const auto* loop = std::get_if<gibbs::For>(&statement.node))
      own.insert(gibbs::foldCase(loop->variable.text));
  });
  const gibbs::Expression* usual = nullptr;
  for (const PathCommand& path : paths)
    if (path.axes[2] != nullptr && below(*path.axes[2])) usual = path.axes[2];
  for (const PathCommand& path : paths) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const gibbs::Expression* value = path.axes[axis];
      if (value == nullptr) continue;
      if (axis < 2 && reads(*value, planes))
        report.at(
            value->range,
            "this goes along {} and counts with the retract plane, which is a height; one of the two is a "
            "misprint; write feed_z, or a value of {}",
            "XYZ"[axis], "XYZ"[axis]);
      if (axis == 2 && reads(*value, points))
        report.at(value->range,
                  "this goes along Z and counts with the point of the operation in X or Y; one of the "
                  "two is a misprint");
    }
    const gibbs::Expression* z = path.axes[2];
    // A number alone is a distance from the plane.
    if (usual == nullptr || z == nullptr || below(*z) || plainNumber(*z)) continue;
    // What the macro works out itself may have the plane in it.
    const std::set<std::string> names = readsOf(*z);
    if (std::any_of(names.begin(), names.end(), [&](const std::string& name) { return own.contains(name); }))
      continue;
    report
        .at(z->range,
            "heights of a path count from the retract plane, and the others of this macro subtract it; "
            "this one goes elsewhere; subtract the plane")
        .note(usual->range, "as here");
  }
}

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros())
    checkMacro(*macro, report);
}

} // namespace

DOTEK_LINT_RULE(path_height_differs){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
