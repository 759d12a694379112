#include "ir/Dataflow.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

constexpr double kLowest = -1e9;

struct Height {
  std::optional<double> z;  // of the last move along Z; nothing: not known
  bool skipped = false;     // a touch went down since
  bool touched = false;     // the tool in the spindle has, on some path
  double highest = kLowest; // of plain moves of this tool on a path to here: that to an alarm is another
  bool shifted = false;     // the coordinates count from elsewhere since
  bool operator==(const Height&) const = default;
};

void checkProgram(const NcProgram& nc, const Probing& probing, Report& report) {
  const ir::Program& program = nc.program;
  const auto& body = program.body;
  if (!endsProgram(program)) return;
  const bool touches = std::any_of(body.begin(), body.end(), [](const ir::ProgramStatement& statement) {
    return skipOf(statement) != nullptr;
  });
  if (!touches) return;
  const auto& modes = nc.modes();
  const auto heights = ir::factsBefore<Height>(
      body, nc.flow(), Height{},
      [&](std::size_t at, std::size_t, Height height) -> Height {
        const auto* block = std::get_if<ir::NcBlock>(&body[at].node);
        if (block != nullptr && hasCode(*block, 'M', 6)) return {}; // another tool
        const auto z = block == nullptr ? std::nullopt : wordValue(*block, 'Z');
        height.touched = height.touched || skipOf(body[at]) != nullptr;
        const bool hasZ = block != nullptr && hasWord(*block, 'Z');
        if (hasZ && !moves(*block)) {
          // The machine stays where it is; Z words before and after are not compared.
          height.shifted = true;
          return height;
        }
        if (hasZ && height.shifted) {
          height.highest = kLowest;
          height.shifted = false;
        }
        const DistanceMode mode = statedMode(body[at]).value_or(*modes[at]);
        const bool absolute = mode == DistanceMode::Absolute;
        if (z && isPlainMove(*block) && (absolute || mode == DistanceMode::AsBefore))
          height.highest = std::max(height.highest, *z);
        const Height unknown{std::nullopt, false, height.touched, height.highest, height.shifted};
        if (probing.step(body[at]).kind == ProbeStep::Kind::Protected || callOf(body[at]) != nullptr)
          return unknown;
        if (block == nullptr) return height;
        for (const double code : {28.0, 30.0, 53.0})
          if (hasCode(*block, 'G', code) && axesOf(*block) != 0) return unknown;
        if (!hasZ) return height;
        return {absolute ? z : std::nullopt, skipOf(body[at]) != nullptr, height.touched, height.highest,
                height.shifted};
      },
      [](Height& into, const Height& other) {
        const Height before = into;
        into.highest = std::max(into.highest, other.highest);
        into.touched = into.touched || other.touched;
        into.shifted = into.shifted || other.shifted;
        if (into.z && (into.z != other.z || into.skipped != other.skipped)) {
          into.z.reset();
          into.skipped = false;
        }
        return into != before;
      });
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!endsProgram(body[i]) || !heights[i] || !heights[i]->z || !heights[i]->touched) continue;
    const double highest = heights[i]->highest;
    if (*heights[i]->z >= highest) continue;
    report.at(
        body[i].origin.range(),
        "the program ends with the stylus at Z {}, below the Z {} that it travels at; the next move of the "
        "machine goes through the part; take it up before",
        *heights[i]->z, highest);
  }
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(ends_at_depth){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
