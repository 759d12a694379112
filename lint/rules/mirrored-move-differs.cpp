#include "lint/PathCommands.h"

namespace dotek::lint::rule {
namespace {

// IF v > 0, or v < 0: the path that the travel v takes.
struct Way {
  std::string field; // folded
  bool positive = false;
};

std::optional<Way> wayOf(const PathCommand& path) {
  if (path.condition == nullptr || path.condition->condition.comparisons.size() != 1) return std::nullopt;
  const gibbs::Comparison& comparison = path.condition->condition.comparisons.front();
  if (!comparison.left || !comparison.right || !comparison.nots.empty()) return std::nullopt;
  const gibbs::Name* name = plainName(*comparison.left);
  const auto zero = plainNumber(*comparison.right);
  if (name == nullptr || !zero || *zero != 0) return std::nullopt;
  switch (comparison.relation) {
  case gibbs::Relation::Greater:
  case gibbs::Relation::GreaterEqual: return Way{gibbs::foldCase(name->text), true};
  case gibbs::Relation::Less:
  case gibbs::Relation::LessEqual: return Way{gibbs::foldCase(name->text), false};
  default: return std::nullopt;
  }
}

// The one axis that is given; 3: none or several.
std::size_t axisOf(const PathCommand& path) {
  std::size_t axis = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    if (path.axes[i] == nullptr) continue;
    if (axis != 3) return 3;
    axis = i;
  }
  return axis;
}

void checkMacro(const gibbs::Macro& macro, const Project& project, Report& report) {
  const std::set<std::string> radii = radiusNames(macro, project);
  const std::vector<PathCommand> paths = pathCommands(macro);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto way = wayOf(paths[i]);
    const std::size_t axis = axisOf(paths[i]);
    if (!way || axis > 1) continue;
    const gibbs::Expression& value = *paths[i].axes[axis];
    // Towards the surface the ball stops one radius before it. With a further term the move begins elsewhere
    // than at 0, and the sign of the travel does not say from which side it comes.
    const std::vector<Term> terms = termsOf(value);
    if (std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
          return !term.name.empty() && term.name != way->field && !radii.contains(term.name);
        }))
      continue;
    for (const std::string& radius : radii) {
      const int sign = signOf(value, radius);
      if (signOf(value, way->field) != 1 || sign != (way->positive ? 1 : -1)) continue;
      report.at(
          value.range,
          "with `{0}` {1} the path goes to the surface and one radius beyond; the ball's centre stops one "
          "radius before it; write `{2}` for the radius",
          way->field, way->positive ? "above 0" : "below 0", way->positive ? "-" : "+");
    }
    if (i == 0) continue;
    const auto before = wayOf(paths[i - 1]);
    const std::size_t axisBefore = axisOf(paths[i - 1]);
    if (!before || before->field != way->field || axisBefore > 2) continue;
    if (before->positive == way->positive)
      report
          .at(paths[i].condition->condition.range,
              "this is the condition of the move before, so both run, or none; the path for the other sign "
              "of "
              "`{}` "
              "is missing; turn the comparison",
              way->field)
          .note(paths[i - 1].condition->condition.range, "the same condition");
    else if (axisBefore != axis)
      report
          .at(paths[i].statement->range,
              "for one sign of `{}` the path goes along {}, for the other along {}; one of the two is a "
              "misprint",
              way->field, "XYZ"[axisBefore], "XYZ"[axis])
          .note(paths[i - 1].statement->range, "the other move");
  }
}

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros())
    checkMacro(*macro, project, report);
}

} // namespace

DOTEK_LINT_RULE(mirrored_move_differs){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
