// Where a case depends on the last digit of what is measured.
#include "ir/Program.h"
#include "targets/CycleCasesParts.h"
#include "targets/Stage.h"

#include <algorithm>

namespace dotek::targets {

// The part of the case with its touches moved along their ways; nullopt: its part is not made of touches.
std::optional<sim::Part> CaseRunner::partBeside(const Values& values, const verify::PartError& more,
                                                const SourceQuestions::Growth& grown) const {
  if (!values.path || values.path->touches.empty() || plan_.part) return std::nullopt;
  std::vector<verify::Touch> touches = values.path->nominal();
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (!grown.touch || (i >= *grown.touch && i < *grown.touch + grown.count))
      touches[i].point =
          touches[i].point +
          touches[i].direction * (grown.by * (grown.uneven ? 1.0 + double(i * i * 7 % 31) : 1.0)) +
          grown.moved;
  verify::PartError error = values.drawn.error;
  error.shift = error.shift + more.shift;
  error.turn += more.turn;
  const double radius = values.drawn.hosts.at("tool_radius");
  return verify::partOf(touches, radius, std::max(radius, kReach), error);
}

// Whether both go the same way with the surfaces a little nearer, and a little farther, whoever calls: what
// differs at the place between depends on the last digit of what is measured, which other arithmetic or other
// macros do not share.
bool CaseRunner::meetsLimit(const Values& values, bool probeOn) {
  constexpr double kBeside = 0.003; // mm: more than the digits of any control leave
  if (target_->meetsLimitsAlike() || !values.posted) return false;
  const auto& body = values.posted->file.programs.front().body;
  const bool compares = std::any_of(body.begin(), body.end(), [](const ir::ProgramStatement& one) {
    return std::holds_alternative<ir::Branch>(one.node);
  });
  if (!compares) return false;
  const auto alike = [&](bool uneven) {
    // Most of what differs does so there, too, and shows without other callers.
    for (const bool asks : {false, true})
      for (const double by : {kBeside, -kBeside}) {
        // Its questions move surfaces one by one, and the others are equal there.
        if (asks && (uneven || !values.drawn.callers)) break;
        const std::optional<sim::Part> part =
            partBeside(values, {}, {.by = uneven ? by / 6 : by, .uneven = uneven});
        if (!part) return false;
        sim::World world(*part, probeFor(plan_, values.drawn));
        const verify::Record source = runPosted(values, world, probeOn, verify::Stand::Way::Run);
        const TargetRun ran = runTarget(values, world, probeOn, &source, nullptr, asks);
        if (ran.refused || ran.undecided || !ran.differences.empty()) return false;
      }
    return true;
  };
  if (alike(false)) return true;
  // Of two results that are equal one is the greater where surfaces lie unevenly. What only other callers see
  // is no such difference.
  sim::World world(*values.part, probeFor(plan_, values.drawn));
  const verify::Record source = runPosted(values, world, probeOn, verify::Stand::Way::Run);
  return !runTarget(values, world, probeOn, &source, nullptr, false).differences.empty() && alike(true);
}

} // namespace dotek::targets
