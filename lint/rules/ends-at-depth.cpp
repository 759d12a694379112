#include "ir/Dataflow.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

// Statements after which the program may come to the end at `end`.
std::vector<bool> leadingTo(std::size_t end, const ir::ProgramFlow& flow) {
  std::vector<std::vector<std::size_t>> before(flow.next.size());
  for (std::size_t at = 0; at < flow.next.size(); ++at)
    for (const std::size_t to : flow.next[at])
      if (to < before.size()) before[to].push_back(at);
  std::vector<bool> out(flow.next.size());
  std::vector<std::size_t> open{end};
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::size_t from : before[at])
      if (!out[from]) {
        out[from] = true;
        open.push_back(from);
      }
  }
  return out;
}

struct Height {
  std::optional<double> z; // of the last move along Z; nothing: not known
  bool skipped = false;    // a touch went down since
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
    if (!endsProgram(body[i]) || !heights[i] || !heights[i]->z) continue;
    // Heights on other ways, those to an alarm, are none that it travels at.
    double highest = -1e9;
    const std::vector<bool> leads = leadingTo(i, nc.flow());
    for (std::size_t at = 0; at < body.size(); ++at)
      if (leads[at] && isPlainMove(body[at]))
        if (const auto z = wordValue(std::get<ir::NcBlock>(body[at].node), 'Z'))
          highest = std::max(highest, *z);
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
