// A run whose path never comes near the part.
#include "sim/run/SimWorld.h"
#include "support/Decimal.h"
#include "support/messages/Part.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace dotek::sim {

void SimWorld::followClearance(const MachineMotion& motion) {
  works_ = works_ || motion.kind != MotionKind::Rapid;
  if (!clearance_ || clearance_->isNear()) return;
  if (!motion.known) {
    clearance_.reset();
    return;
  }
  if (!clearance_->follow(world_->part(), world_->centreAt(motion.from), world_->centreAt(motion.to))) return;
  // To know the place of a plain block copies its line: that of one a little less near does.
  constexpr double kAsNear = 0.9;
  if (clearance_->least() > kAsNear * nearest_.distance) return;
  nearest_ = {clearance_->least(), rangeNow_ ? rangeNow_() : place_().range, frame_().name,
              systemNow_ ? systemNow_() : std::nullopt};
}

// The run has passed, and nothing was where it went. What met something, or has missed it, was reported.
void SimWorld::tellFar() {
  if (!end_ || !clearance_ || clearance_->isNear() || !works_ || contactCount_ > 0 || offsetTold_) return;
  const Ending ending = end_().ending;
  if (ending != Ending::ProgramEnd && ending != Ending::TextEnd) return;
  if (std::any_of(outcomes_.begin(), outcomes_.end(), [](std::uint64_t met) { return met > 0; })) return;
  const std::string system = nearest_.system.starts_with('G') ? nearest_.system : "G54";
  const bool atMachineZero = nearest_.unset && partZero_ && *partZero_ != std::array<double, 3>{};
  Diagnostic one = makeDiagnostic<diag::PathFarFromPart>(
      nearest_.range, fixedText(clearance_->least(), 0),
      atMachineZero
          ? fmt::format(
                "nobody has set {0}, and `--work-offset {0}=part` puts it where the part is meant to be",
                system)
          : fmt::format(
                "`--work-offset {}=X,Y,Z` says where the zero is (`=part`: where the part is meant to "
                "be), `--at X,Y,Z` where the run begins",
                system));
  noteStart(one);
  faults_.push_back(
      {Verdict::Doubt, "PASS, FAR FROM THE PART", one.message.substr(0, one.message.find(';'))});
  session_.diagnostics().add(std::move(one));
}

} // namespace dotek::sim
