// Programs beside their conversion where the probe meets something else than the part, and where the caller
// has other modes in force.
#include "backends/fanuc/TargetProgramPlayed.h"
#include "targets/MissedTouches.h"

#include <fmt/format.h>

namespace dotek::targets {

std::optional<verify::Difference> ProgramRunner::compareReturn(const verify::Record& source,
                                                               const verify::Record& target) const {
  if (!caller_ || source.ending != verify::Ending::Finished || target.ending != verify::Ending::Finished)
    return std::nullopt;
  const bool ends = inSource(source.lastBlock).hasPlace(), endsToo = translation_.line(target.lastBlock) != 0;
  if (ends == endsToo) return std::nullopt;
  return verify::Difference{verify::Aspect::Ending,
                            ends ? "it goes back to its caller in place of ending"
                                 : "it ends in place of going back to its caller (M99)",
                            source.lastBlock, target.lastBlock};
}

verify::Record ProgramRunner::runBeside(const Side& side, const Played& played, const Beside& beside) const {
  sim::World world(*played.part, probeFor(plan_, played.drawn), limits());
  return runSide(side, played.drawn, world, verify::Stand::Way::Run, beside);
}

std::vector<verify::Difference> ProgramRunner::compareDisturbed(const Side& source, const Played& played,
                                                                const verify::Record& target) const {
  const DisturbedSides sides{[&](const verify::Interference& by) -> std::optional<verify::Record> {
                               verify::Record out = runBeside(source, played, {by, nullptr});
                               if (out.ending == verify::Ending::Inconclusive) return std::nullopt;
                               return out;
                             },
                             [&](const verify::Interference& by) {
                               return runBeside(targetSide(), played, {by, nullptr});
                             },
                             [&](const verify::Record&) { return rules(); }};
  if (!played.rehearsed) return targets::compareDisturbed(played.record, target, sides);
  // A rehearsal meets nothing, and counts nothing.
  return targets::compareDisturbed(runBeside(source, played, {}), runBeside(targetSide(), played, {}), sides);
}

std::vector<verify::Difference> ProgramRunner::compareUnder(const verify::ModeInForce& mode,
                                                            const Side& source, const Played& played) const {
  const verify::Record meant = runBeside(source, played, {{}, &mode});
  SourceRange at;
  if (meant.ending != verify::Ending::Finished ||
      (!meant.measures.empty() && !verify::whyNoEvidence(meant, at).empty()))
    return {};
  const verify::Record ran = runBeside(targetSide(), played, {{}, &mode});
  std::vector<verify::Difference> out = verify::compare(meant, ran, rules());
  if (out.empty())
    if (std::optional<verify::Difference> one = compareReturn(meant, ran)) out.push_back(std::move(*one));
  for (verify::Difference& one : out)
    one.text = fmt::format("called {}: {}", mode.who, one.text);
  return out;
}

// A difference that digits alone make is none of these.
std::vector<verify::Difference> ProgramRunner::compareBeside(const Played& played,
                                                             const verify::Record& target) const {
  if (played.record.ending != verify::Ending::Finished) return {};
  const auto compared = [&](const auto& look) {
    std::vector<verify::Difference> out = look(sourceSide());
    return out.empty() || !sourceAsTarget_ || !look(sourceAsTargetSide()).empty()
               ? out
               : std::vector<verify::Difference>{};
  };
  if (auto out = compared([&](const Side& source) { return compareDisturbed(source, played, target); });
      !out.empty())
    return out;
  if (!caller_) return {};
  for (const verify::ModeInForce& mode : verify::modesInForce(*sourceControl_, *targetControl_))
    if (auto out = compared([&](const Side& source) { return compareUnder(mode, source, played); });
        !out.empty())
      return out;
  return {};
}

} // namespace dotek::targets
