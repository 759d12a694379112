// Skip moves that met nothing: what the program makes of where they ended.
#include "sim/run/SimWorld.h"
#include "support/Decimal.h"
#include "support/messages/Part.h"

#include <fmt/format.h>
#include <utility>

namespace dotek::sim {
namespace {

constexpr std::size_t kUsedMiss = 15; // among what is reported, after the outcomes

std::string machinePoint(const Point3& p) {
  return fmt::format("X{} Y{} Z{}", fixedText(p.x, 3), fixedText(p.y, 3), fixedText(p.z, 3));
}

} // namespace

void SimWorld::missEnded(const MachineMotion& motion) {
  if (!missed_) return;
  missed_->movedOn = motion.kind != MotionKind::Skip;
  if (missed_->movedOn || std::exchange(missed_->ended, true)) return;
  const Point3 way{motion.to[0] - motion.from[0], motion.to[1] - motion.from[1],
                   motion.to[2] - motion.from[2]};
  PictureMeasured& row = missed_->row;
  row.found = MeasuredLog::measurementOf(work_(), way, "no touch");
  row.system = frame_().name;
  row.block = block_ ? block_() : blockNow();
  const std::size_t moves = recorder_ ? recorder_->picture().moves.size() : 0;
  row.move = moves == 0 ? 0 : moves - 1;
}

// A position that is kept without a question may be one to go back to.
void SimWorld::positionRead(bool skip) {
  if (!missed_ || !asks_ || (!skip && missed_->movedOn)) return;
  if (asks_())
    settleMiss();
  else if (skip)
    useMiss();
}

void SimWorld::useMiss() {
  Missed missed = std::move(*missed_);
  missed_.reset();
  ++usedMisses_;
  if (missed.index < events_.size()) events_[missed.index].event.used = true;
  const RunPlace place = place_();
  Diagnostic one = makeDiagnostic<diag::MissMeasured>(
      missed.kept.place.range, machinePoint(missed.kept.event.centre), blockNow().text);
  if (recorder_) recorder_->missUsed(one.message);
  one.note(place.range, "used here");
  addTold(std::move(one), kUsedMiss, missed.kept.place);
  log_.missed(std::move(missed.row));
}

void SimWorld::settleMiss() {
  if (!missed_) return;
  const Kept kept = std::move(missed_->kept);
  missed_.reset();
  if (isTold(kept.event)) tell(kept.event, kept.place);
}

} // namespace dotek::sim
