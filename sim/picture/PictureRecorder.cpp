#include "sim/picture/PictureRecorder.h"

#include <utility>

namespace dotek::sim {

PictureRecorder::PictureRecorder(Picture empty, World* world, CallKind callKind, BlockNow blockNow)
    : picture_(std::move(empty)), world_(world), callKind_(std::move(callKind)), block_(std::move(blockNow)),
      on_(picture_.probe.on) {}

std::size_t PictureRecorder::blockNow() {
  PictureBlock block = block_();
  const auto [found, isNew] = places_.try_emplace(block.place + '\n' + block.text, picture_.blocks.size());
  if (isNew) picture_.blocks.push_back(std::move(block));
  return found->second;
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
  return PathKind::Measuring;
}

// The events of the world from the `from`-th on belong to this move.
void PictureRecorder::addEvents(std::size_t from, std::size_t move) {
  if (world_ == nullptr || full_) return;
  for (std::size_t i = from; i < world_->events().size(); ++i) {
    const ProbeEvent& event = world_->events()[i];
    if (event.outcome == Outcome::Contact) {
      picture_.contacts.push_back({event.point, move});
      continue;
    }
    if (event.outcome == Outcome::Miss) continue;
    Diagnostics said;
    reportEvent(event, {}, said);
    for (const Diagnostic& one : said.all())
      picture_.errors.push_back({event.centre, one.message, move});
  }
}

// The motion of a skip move is reported after its contact.
std::optional<double> PictureRecorder::contact(const SkipMove& move) {
  if (world_ == nullptr) return std::nullopt;
  full_ = full_ || picture_.moves.size() == kMostMoves;
  const std::size_t before = world_->events().size();
  const std::optional<double> share = world_->contact(move);
  addEvents(before, picture_.moves.size());
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
    picture_.moves.push_back({kindOf(motion.kind), centre(motion.from), centre(motion.to), on_, blockNow()});
  }
  if (world_ == nullptr) return;
  const std::size_t before = world_->events().size();
  world_->moved(motion);
  addEvents(before, picture_.moves.empty() ? 0 : picture_.moves.size() - 1);
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
