// Skip moves that met nothing: what the program makes of where they ended.
#include "sim/run/SimWorld.h"
#include "support/Decimal.h"
#include "support/messages/Part.h"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace dotek::sim {
namespace {

constexpr double kSomeWay = 1e-6;                       // mm along an axis
constexpr std::size_t kUnseenMiss = 14, kUsedMiss = 15; // among what is reported, after the outcomes

std::string machinePoint(const Point3& p) {
  return fmt::format("X{} Y{} Z{}", fixedText(p.x, 3), fixedText(p.y, 3), fixedText(p.z, 3));
}

} // namespace

std::optional<SimWorld::Missed> SimWorld::beginSearch(const SkipMove& move) {
  lastMiss_ = 0;
  movedOn_ = false;
  std::optional<Missed> approach;
  if (goesOn(move)) approach = std::exchange(missed_, std::nullopt);
  settleMiss();
  return approach;
}

void SimWorld::keepMiss(Kept miss, std::size_t index, bool meant) {
  if (misses_.size() < kMostKept) {
    misses_.push_back({miss, index, recorder_ ? recorder_->picture().moves.size() : 0, meant, false, {}, {}});
    lastMiss_ = static_cast<std::uint32_t>(misses_.size());
  }
  if (meant) return;
  missed_.emplace(Missed{std::move(miss), index, {}});
  missed_->number = lastMiss_;
}

// The skip position along the way of the move, and until another motion the place where it has ended.
std::optional<std::size_t> SimWorld::axisOfMiss(std::uint32_t variable) const {
  if (lastMiss_ == 0 || machineNow_ == nullptr) return std::nullopt;
  const stdlib::SystemVariables& v = machineNow_->control().variables;
  const double ways[] = {lastWay_.x, lastWay_.y, lastWay_.z};
  const auto along = [&](std::optional<int> first) -> std::optional<std::size_t> {
    if (!first || static_cast<long>(variable) < *first) return std::nullopt;
    const std::size_t axis = variable - static_cast<std::uint32_t>(*first);
    return axis < 3 && std::abs(ways[axis]) > kSomeWay ? std::optional(axis) : std::nullopt;
  };
  if (const auto axis = along(v.skip)) return axis;
  if (movedOn_) return std::nullopt;
  for (const auto& first : {v.position, v.machine, v.blockEnd})
    if (const auto axis = along(first)) return axis;
  return std::nullopt;
}

std::uint32_t SimWorld::missIn(std::uint32_t variable) const {
  return axisOfMiss(variable) ? lastMiss_ : 0;
}

double SimWorld::wayIn(std::uint32_t variable) const {
  const std::optional<std::size_t> axis = axisOfMiss(variable);
  if (!axis) return 0;
  constexpr double kInch = 25.4;
  const double ways[] = {lastWay_.x, lastWay_.y, lastWay_.z};
  return ways[*axis] / (machineNow_->mode(kUnits) == 0 ? 1 : kInch);
}

void SimWorld::askedAbout(std::uint32_t miss, bool tells, SourceRange block) {
  if (miss == 0 || miss > misses_.size()) return;
  KeptMiss& one = misses_[miss - 1];
  one.seen = one.seen || tells;
  if (!tells) one.blind = block;
}

bool SimWorld::isOpen() const {
  if (lastMiss_ == 0 || lastMiss_ > misses_.size()) return false;
  const KeptMiss& one = misses_[lastMiss_ - 1];
  return !one.seen && !one.blind.hasPlace() && !one.meant;
}

void SimWorld::passedAlarm(SourceRange block) {
  misses_[lastMiss_ - 1].passed = block;
}

// The program came to its end as if each of its searches had found what it looked for.
void SimWorld::tellUnseen() {
  if (!end_) return;
  const Ending ending = end_().ending;
  if (ending != Ending::ProgramEnd && ending != Ending::TextEnd) return;
  for (std::size_t i = 0; i < misses_.size(); ++i) {
    const KeptMiss& miss = misses_[i];
    const SourceRange at = miss.blind.hasPlace() ? miss.blind : miss.passed;
    if (miss.seen || !at.hasPlace() || missesTold_.contains(static_cast<std::uint32_t>(i + 1))) continue;
    const std::string_view why =
        miss.blind.hasPlace()
            ? "the IF that looks at where it ended comes out the same at any place of the move"
            : "the IF before the alarm looks at nothing that comes from where it ended";
    Diagnostic one =
        makeDiagnostic<diag::MissNotSeen>(miss.kept.place.range, machinePoint(miss.kept.event.centre), why);
    faults_.push_back(
        {Verdict::Doubt, "PASS, A MISS NOT SEEN", one.message.substr(0, one.message.find(';'))});
    if (miss.index < events_.size()) events_[miss.index].unseen = true;
    if (miss.meant) ++outcomes_[static_cast<std::size_t>(Outcome::Miss)];
    if (recorder_) recorder_->missNotSeen(miss.move, miss.kept.event.centre, one.message);
    one.note(at, "the IF");
    addTold(std::move(one), kUnseenMiss, miss.kept.place);
  }
}

void SimWorld::checkMiss(const OffsetWrite& write) {
  const std::uint32_t miss = missInHand_ ? missInHand_() : 0;
  if (miss == 0 || miss > misses_.size() || misses_[miss - 1].meant) return;
  log_.writtenAfterMiss();
  if (missesTold_.contains(miss)) return;
  const Kept& kept = misses_[miss - 1].kept;
  const RunPlace place = place_();
  Diagnostic one = makeDiagnostic<diag::MissWritten>(
      place.range, write.name, fixedText(write.before, decimals_), fixedText(write.after, decimals_));
  one.note(kept.place.range, "this skip move met nothing, and ended at " + machinePoint(kept.event.centre));
  addFault(std::move(one), Verdict::Fail, "FAIL: OFFSET SET WITHOUT A TOUCH", place);
}

void SimWorld::shiftedBy(std::uint32_t miss) {
  if (miss == 0 || miss > misses_.size() || misses_[miss - 1].meant || missesTold_.contains(miss)) return;
  const Kept& kept = misses_[miss - 1].kept;
  const RunPlace place = place_();
  Diagnostic one = makeDiagnostic<diag::MissShifts>(place.range, blockNow().text);
  one.note(kept.place.range, "this skip move met nothing, and ended at " + machinePoint(kept.event.centre));
  addFault(std::move(one), Verdict::Fail, "FAIL: SHIFTED WITHOUT A TOUCH", place);
}

// The machine is still where the skip move has ended that nobody has asked about: whatever coordinates it
// gets, they are those of no surface.
void SimWorld::placeSet(std::uint32_t axes) {
  if (!missed_ || missed_->movedOn || isProtected()) return;
  const double ways[] = {missed_->way.x, missed_->way.y, missed_->way.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if ((axes >> axis & 1) == 0 || std::abs(ways[axis]) <= kSomeWay) continue;
    const Missed missed = std::move(*missed_);
    missed_.reset();
    if (missed.index < events_.size()) events_[missed.index].event.used = true;
    log_.writtenAfterMiss();
    shiftedBy(missed.number);
    missesTold_.insert(missed.number);
    return;
  }
}

void SimWorld::missEnded(const MachineMotion& motion) {
  if (motion.kind != MotionKind::Skip)
    movedOn_ = true;
  else if (lastMiss_ != 0)
    lastWay_ = {motion.to[0] - motion.from[0], motion.to[1] - motion.from[1], motion.to[2] - motion.from[2]};
  if (!missed_) return;
  missed_->movedOn = motion.kind != MotionKind::Skip;
  if (missed_->movedOn || std::exchange(missed_->ended, true)) return;
  const Point3 way{motion.to[0] - motion.from[0], motion.to[1] - motion.from[1],
                   motion.to[2] - motion.from[2]};
  missed_->way = way;
  PictureMeasured& row = missed_->row;
  row.found = MeasuredLog::measurementOf(work_(), way, "no touch");
  row.system = frame_().name;
  row.block = block_ ? block_() : blockNow();
  const std::size_t moves = recorder_ ? recorder_->picture().moves.size() : 0;
  row.move = moves == 0 ? 0 : moves - 1;
}

// A position that is kept without a question may be one to go back to.
void SimWorld::positionRead(bool skip) {
  noteHeight();
  log_.positionRead();
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
  missesTold_.insert(missed.number);
  if (missed.index < events_.size()) events_[missed.index].event.used = true;
  const RunPlace place = place_();
  Diagnostic one = makeDiagnostic<diag::MissMeasured>(
      missed.kept.place.range, machinePoint(missed.kept.event.centre), blockNow().text);
  if (recorder_) recorder_->missUsed(one.message);
  one.note(place.range, "used here");
  noteStart(one);
  addTold(std::move(one), kUsedMiss, missed.kept.place);
  log_.missed(std::move(missed.row));
}

void SimWorld::settleMiss() {
  if (!missed_) return;
  const Missed missed = std::move(*missed_);
  missed_.reset();
  tellMiss(missed);
}

void SimWorld::tellMiss(const Missed& miss) {
  if (isTold(miss.kept.event)) tell(miss.kept.event, miss.kept.place);
}

// Nothing has moved or asked since, and the new move goes the same way: fast to the face, then slowly on it.
bool SimWorld::goesOn(const SkipMove& move) const {
  if (!missed_ || !missed_->ended || missed_->movedOn || move.positions || isProtected()) return false;
  const Point3 way{move.machineTo[0] - move.machineFrom[0], move.machineTo[1] - move.machineFrom[1],
                   move.machineTo[2] - move.machineFrom[2]};
  const Point3& before = missed_->way;
  const double lengths = way.length() * before.length();
  constexpr double kSameWay = 0.9999; // of the cosine
  return lengths > 0 && way.dot(before) > kSameWay * lengths;
}

void SimWorld::takeBackMiss(const Missed& miss) {
  --outcomes_[static_cast<std::size_t>(miss.kept.event.outcome)];
  if (miss.number > 0) misses_[miss.number - 1].seen = true;
  if (miss.index + 1 == events_.size()) {
    events_.pop_back();
    --eventCount_;
  }
  if (recorder_) recorder_->missWasApproach();
}

} // namespace dotek::sim
