#include "frontend/gibbs/Run.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <map>

namespace dotek::lint::rule {
namespace {

constexpr double kRadius = 3.0;   // of the ball, mm
constexpr double kRetract = 50.0; // the plane at which an operation begins and ends
constexpr double kSame = 1e-6;    // mm
constexpr std::uint32_t kMostSteps = 20000;

// The path for the first values; nothing where it depends on more.
std::optional<std::vector<gibbs::PathMove>> pathOf(const gibbs::Cycle& cycle, const Project& project) {
  std::map<std::string, double> fields;
  for (const gibbs::Field& field : gibbs::declaredFields(cycle)) {
    if (!field.value) return std::nullopt;
    fields.emplace(gibbs::foldCase(field.name.text), *field.value);
  }
  Limits limits = project.limits;
  limits.steps = std::min(limits.steps, kMostSteps);
  Diagnostics ignored;
  gibbs::RunContext context{project.sources,
                            project.gibbsKeywords,
                            limits,
                            ignored,
                            fields,
                            {{"tool_radius", kRadius},
                             {"tool_number", 1},
                             {"retract", kRetract},
                             {"start_x", 0},
                             {"start_y", 0},
                             {"start_z", 0}},
                            {},
                            [](const std::string&, SourceRange) -> const gibbs::Macro* { return nullptr; },
                            [](const std::string&, SourceRange) -> const gibbs::Dialog* { return nullptr; }};
  return gibbs::runToolPath(*cycle.toolPath, context);
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (!cycle->toolPath || cycle->toolPath->hasErrorNodes || !cycle->dialog) continue;
    const auto path = pathOf(*cycle, project);
    if (!path || path->size() < 2) continue;
    const auto lower = [](const gibbs::PathMove& a, const gibbs::PathMove& b) { return a.z < b.z; };
    const double lowest = std::min_element(path->begin(), path->end(), lower)->z;
    const double highest = std::max_element(path->begin(), path->end(), lower)->z;
    const gibbs::PathMove& last = path->back();
    // All on one height: the moves down and up are somebody else's, unless the path goes there itself.
    const bool goesDown = std::any_of(path->begin(), path->end(), [](const gibbs::PathMove& move) {
      return move.kind == gibbs::PathMove::Kind::FeedZ && move.z < -kSame;
    });
    // Where the operation begins it may end.
    if (last.z > -kSame || last.z > lowest + kSame || (highest - lowest < kSame && !goesDown)) continue;
    report.at(
        last.range,
        "the path ends at its lowest height, Z {} with the first values; the probe is not taken up, and the "
        "next travel goes through the part; write the move up at the end",
        last.z + kRetract);
  }
}

} // namespace

DOTEK_LINT_RULE(path_ends_down){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
