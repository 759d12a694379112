#include "ir/Dataflow.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

struct Height {
  std::optional<double> z; // of the last move along Z; nothing: not known
  bool skipped = false;    // a touch went down since
  bool operator==(const Height&) const = default;
};

void checkProgram(const NcProgram& nc, const Probing& probing, Report& report) {
  const ir::Program& program = nc.program;
  const auto& body = program.body;
  if (!endsProgram(program)) return;
  double highest = -1e9;
  bool touches = false;
  for (const ir::ProgramStatement& statement : body) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    touches = touches || skipOf(statement) != nullptr;
    if (block != nullptr && isPlainMove(statement))
      if (const auto z = wordValue(*block, 'Z')) highest = std::max(highest, *z);
  }
  if (!touches) return;
  const auto& modes = nc.modes();
  const auto heights = ir::factsBefore<Height>(
      body, nc.flow(), Height{},
      [&](std::size_t at, std::size_t, Height height) -> Height {
        const auto* block = std::get_if<ir::NcBlock>(&body[at].node);
        if (probing.step(body[at]).kind == ProbeStep::Kind::Protected || callOf(body[at]) != nullptr)
          return {};
        if (block == nullptr) return height;
        for (const double code : {28.0, 30.0, 53.0})
          if (hasCode(*block, 'G', code) && axesOf(*block) != 0) return {};
        if (!hasWord(*block, 'Z')) return height;
        const bool absolute = statedMode(body[at]).value_or(*modes[at]) == DistanceMode::Absolute;
        if (skipOf(body[at]) != nullptr) return {absolute ? wordValue(*block, 'Z') : std::nullopt, true};
        return {absolute ? wordValue(*block, 'Z') : std::nullopt, false};
      },
      [](Height& into, const Height& other) {
        if (into == other || !into.z) return false;
        into = {};
        return true;
      });
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!endsProgram(body[i]) || !heights[i] || !heights[i]->z || *heights[i]->z >= highest) continue;
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
