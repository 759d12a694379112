#include "sim/picture/PictureRecorder.h"

#include "sim/machine/Axes.h"
#include "sim/machine/EndText.h"
#include "sim/picture/PictureRegion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotek::sim {
namespace {

bool isSame(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}
bool isSame(const PictureFrame& a, const PictureFrame& b) {
  return a.name == b.name && a.unknown == b.unknown && isSame(a.shift.x, b.shift.x) &&
         isSame(a.shift.y, b.shift.y) && isSame(a.shift.z, b.shift.z) && a.length == b.length;
}

} // namespace

// An axis of which the place in the machine is not known: where the path goes is not, either.
void PictureRecorder::forgetLost(PictureMove& move) const {
  const std::uint8_t lost = move.frame < picture_.frames.size() ? picture_.frames[move.frame].unknown : 7;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if ((lost >> axis & 1) != 0) setCoordinate(move.to, axis, std::nan(""));
    if (!picture_.moves.empty() && std::isnan(coordinate(picture_.moves.back().to, axis)))
      setCoordinate(move.from, axis, std::nan(""));
  }
}

PictureFrame frameOf(const Machine& machine) {
  const Position gauge = machine.machinePosition(), &work = machine.position();
  const auto shift = [&](std::size_t axis) {
    return (machine.uncertain() >> axis & 1) != 0 ? std::nan("") : snap(gauge[axis] - work[axis]);
  };
  PictureFrame out{systemName(machine), {shift(0), shift(1), shift(2)}};
  out.length = machine.toolLength();
  const Position known = machine.knownMachinePosition();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::isnan(known[axis])) out.unknown |= static_cast<std::uint8_t>(1u << axis);
  return out;
}

PictureRecorder::PictureRecorder(Picture empty, World* world, CallKind callKind, BlockNow blockNow)
    : picture_(std::move(empty)), world_(world), callKind_(std::move(callKind)), block_(std::move(blockNow)),
      on_(picture_.probe.on) {}

std::size_t PictureRecorder::placeOf(PictureBlock block) {
  const auto [found, isNew] = places_.try_emplace(block.place + '\n' + block.text, picture_.blocks.size());
  if (isNew) picture_.blocks.push_back(std::move(block));
  return found->second;
}

std::size_t PictureRecorder::frameNow() {
  if (!frame_) return picture_.frames.size();
  PictureFrame frame = frame_();
  if (picture_.frames.empty() || !isSame(picture_.frames.back(), frame))
    picture_.frames.push_back(std::move(frame));
  return picture_.frames.size() - 1;
}

std::size_t PictureRecorder::toolNow() {
  if (world_ == nullptr) return 0;
  const bool unknown = world_->isUnknownTool();
  const CuttingTool* const listed = world_->cuttingTool();
  if (listed == nullptr && !unknown) return 0;
  const PictureTool tool{listed != nullptr ? *listed : world_->unknownTool(), !unknown};
  std::vector<PictureTool>& tools = picture_.tools;
  const auto found = std::find_if(tools.begin(), tools.end(), [&](const PictureTool& one) {
    return one.number == tool.number && one.length == tool.length;
  });
  const auto place = static_cast<std::size_t>(found - tools.begin());
  if (found == tools.end()) tools.push_back(tool);
  return place + 1;
}

PathKind PictureRecorder::kindOf(MotionKind kind) const {
  switch (kind) {
  case MotionKind::Rapid: return PathKind::Rapid;
  case MotionKind::Feed: return PathKind::Feed;
  case MotionKind::Skip: break;
  }
  // The innermost call that has a say.
  for (auto call = calls_.rbegin(); call != calls_.rend(); ++call)
    if (*call) return **call;
  return safe_ && safe_() ? PathKind::Protected : PathKind::Measuring;
}

// The events of the world from the `from`-th on belong to this move.
void PictureRecorder::addEvents(std::size_t from, std::size_t move, bool isProtected) {
  if (world_ == nullptr || full_) return;
  for (std::size_t i = from; i < world_->events().size(); ++i) {
    const ProbeEvent& event = world_->events()[i];
    if (event.outcome == Outcome::Contact) {
      picture_.contacts.push_back({event.point, move});
      continue;
    }
    const bool miss = event.outcome == Outcome::Miss || event.outcome == Outcome::SetterMiss;
    if (miss && (isProtected || event.meant)) continue;
    Diagnostics said;
    reportEvent(event, {}, said);
    for (const Diagnostic& one : said.all())
      picture_.errors.push_back({event.centre, one.message, move, std::nullopt,
                                 miss ? PictureError::Kind::Miss : PictureError::Kind::Error});
  }
}

void PictureRecorder::missUsed(const std::string& text) {
  const auto last = std::find_if(picture_.errors.rbegin(), picture_.errors.rend(), isMiss);
  if (full_ || last == picture_.errors.rend()) return;
  last->kind = PictureError::Kind::UsedMiss;
  last->text = text;
}

void PictureRecorder::missNotSeen(std::size_t move, const Point3& at, const std::string& text) {
  if (move >= picture_.moves.size()) return;
  picture_.moves[move].kind = PathKind::Measuring;
  auto error = std::find_if(picture_.errors.begin(), picture_.errors.end(),
                            [&](const PictureError& one) { return isMiss(one) && one.move == move; });
  if (error == picture_.errors.end())
    error = picture_.errors.insert(error, {at, text, move, std::nullopt, PictureError::Kind::Miss});
  error->text = text;
  error->fault = true;
}

// The control stops the machine where its travel ends.
void PictureRecorder::endAtTravel(std::size_t from) {
  for (std::size_t i = from; i < world_->events().size(); ++i) {
    const ProbeEvent& event = world_->events()[i];
    if (event.outcome != Outcome::OutsideTravel) continue;
    PictureMove& move = picture_.moves.back();
    move.to = move.from + (move.to - move.from) * event.share;
    return;
  }
}

void PictureRecorder::faultHere(const std::string& text, std::optional<Point3> at) {
  if (full_) return;
  const double nan = std::nan("");
  const bool moved = !picture_.moves.empty();
  PictureError error{at      ? *at
                     : moved ? picture_.moves.back().to
                             : Point3{nan, nan, nan},
                     text, at || !moved ? picture_.moves.size() : picture_.moves.size() - 1,
                     placeOf(block_())};
  error.fault = true;
  picture_.errors.push_back(std::move(error));
}

void PictureRecorder::missWasApproach() {
  const auto last = std::find_if(picture_.errors.rbegin(), picture_.errors.rend(), isMiss);
  if (full_ || last == picture_.errors.rend()) return;
  if (last->move < picture_.moves.size()) picture_.moves[last->move].kind = PathKind::Protected;
  picture_.errors.erase(std::next(last).base());
}

// The motion of a skip move is reported after its contact.
std::optional<double> PictureRecorder::contact(const SkipMove& move) {
  if (world_ == nullptr) return std::nullopt;
  full_ = full_ || picture_.moves.size() == kMostMoves;
  const std::size_t before = world_->events().size();
  const std::optional<double> share = world_->contact(move);
  addEvents(before, picture_.moves.size(), kindOf(MotionKind::Skip) == PathKind::Protected);
  return share;
}

bool PictureRecorder::isThere(const SkipMove& here) {
  return world_ != nullptr && world_->isThere(here);
}

void PictureRecorder::moved(const MachineMotion& motion) {
  full_ = full_ || picture_.moves.size() == kMostMoves;
  if (!full_) {
    const auto centre = [&](const Position& at) {
      return world_ != nullptr ? world_->centreAt(at) : Point3{at[0], at[1], at[2]};
    };
    PictureMove move{kindOf(motion.kind), centre(motion.from), centre(motion.to), on_,
                     placeOf(block_()),   frameNow(),          toolNow()};
    if (!motion.known) forgetLost(move);
    picture_.moves.push_back(move);
  }
  if (world_ == nullptr) return;
  const std::size_t before = world_->events().size();
  world_->moved(motion);
  if (!full_) endAtTravel(before);
  addEvents(before, picture_.moves.empty() ? 0 : picture_.moves.size() - 1);
}

void PictureRecorder::standStill(const PictureBlock& block) {
  const double nan = std::nan("");
  const Point3 at = here_ ? here_() : Point3{nan, nan, nan};
  if (std::isnan(at.x) && std::isnan(at.y) && std::isnan(at.z)) return;
  picture_.still = true;
  PictureMove move{PathKind::Feed, at, at, on_, placeOf(block), frameNow(), toolNow()};
  forgetLost(move);
  move.from = move.to;
  picture_.moves.push_back(move);
  for (PictureError& error : picture_.errors)
    if (std::isnan(error.at.x) && std::isnan(error.at.y) && std::isnan(error.at.z)) error.at = move.to;
}

void PictureRecorder::finish(const RunFacts& facts, std::vector<PictureMeasured> measured) {
  // What has become unknown since the last move: the place at the end is not that of the move.
  if (frame_ && !picture_.moves.empty() && !full_) {
    const std::size_t last = picture_.moves.back().frame, now = frameNow();
    const auto lost = [&](std::size_t frame) {
      const PictureFrame& one = picture_.frames[frame];
      return (std::isnan(one.shift.x) ? 1 : 0) + (std::isnan(one.shift.y) ? 1 : 0) +
             (std::isnan(one.shift.z) ? 1 : 0);
    };
    if (last < picture_.frames.size() && lost(now) > lost(last)) picture_.moves.back().frame = now;
  }
  const std::string why = endingText(facts);
  if (picture_.moves.empty() && (!why.empty() || !picture_.errors.empty())) standStill(facts.block);
  picture_.measured = std::move(measured);
  picture_.result = resultOf(picture_, facts);
  if (why.empty() || isSaidByTravel(facts)) return;
  const std::size_t move = picture_.moves.empty() ? 0 : picture_.moves.size() - 1;
  // Without a move the place is not known; no number is not drawn.
  const double nan = std::nan("");
  picture_.errors.push_back({picture_.moves.empty() ? Point3{nan, nan, nan} : picture_.moves.back().to, why,
                             move, placeOf(facts.block)});
}

void PictureRecorder::probeSwitched(bool on) {
  on_ = on;
  if (world_ != nullptr) world_->probeSwitched(on);
}

void PictureRecorder::callBegins(std::uint32_t program, std::span<const double> locals) {
  calls_.push_back(callKind_(program, locals));
  if (world_ != nullptr) world_->callBegins(program, locals);
}

void PictureRecorder::callEnded(std::uint32_t program) {
  if (!calls_.empty()) calls_.pop_back();
  if (world_ != nullptr) world_->callEnded(program);
}

} // namespace dotek::sim
