// Collects what pictures draw while a program runs. It is between a machine and its world: it is the skip
// signal and the watcher of the machine, and hands every call on.
#pragma once

#include "sim/machine/World.h"
#include "sim/picture/Picture.h"
#include "sim/picture/PictureResult.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dotek::sim {

// The work coordinates that a control shows now; axes whose position is not known have no number.
PictureFrame frameOf(const Machine& machine);

class PictureRecorder final : public SkipSignal, public MotionWatcher {
public:
  // What comes later is not drawn; contacts and errors neither.
  static constexpr std::size_t kMostMoves = 200'000;

  // What a call with arguments makes of the skip moves within it; nothing: it has no say.
  using CallKind =
      std::function<std::optional<PathKind>(std::uint32_t program, std::span<const double> locals)>;
  // The block that runs now; asked once a motion.
  using BlockNow = std::function<PictureBlock()>;
  // The work coordinates after a motion.
  using FrameNow = std::function<PictureFrame()>;

  // `empty`: title, part and probe. `world`: gets every call and outlives the recorder; nullptr: no signal
  // comes, and the moves are those of the spindle's gauge line.
  PictureRecorder(Picture empty, World* world, CallKind callKind, BlockNow blockNow);

  void setFrame(FrameNow frame) { frame_ = std::move(frame); } // without it they are not known
  // Where the ball is now; no number: not known.
  void setPlace(std::function<Point3()> here) { here_ = std::move(here); }
  void setSafeMove(std::function<bool()> safe) { safe_ = std::move(safe); } // the skip move that runs is one
  // The program takes the end of the last miss for the surface; `text` says so.
  void missUsed(const std::string& text);
  // The program has not seen that this skip move met nothing; `text` says so.
  void missNotSeen(std::size_t move, const Point3& at, const std::string& text);
  // A finding of the run at the block that runs; where the machine is, or where its last motion ended.
  void faultHere(const std::string& text, std::optional<Point3> at = std::nullopt);
  // The last miss was an approach: it is no error.
  void missWasApproach();
  void addList(PictureList list) { picture_.lists.push_back(std::move(list)); }
  // After the run: what stopped it is an error at the end of the path, and the picture has its banner.
  void finish(const RunFacts& facts, std::vector<PictureMeasured> measured = {});

  std::optional<double> contact(const SkipMove& move) override;
  bool isThere(const SkipMove& here) override;
  void moved(const MachineMotion& motion) override;
  void probeSwitched(bool on) override;
  void callBegins(std::uint32_t program, std::span<const double> locals) override;
  void callEnded(std::uint32_t program) override;

  bool isFull() const { return full_; } // motions are missing
  const Picture& picture() const { return picture_; }

private:
  void standStill(const PictureBlock& block); // of a run that makes no move: where it is
  void endAtTravel(std::size_t from); // the last move, by the events of the world from the `from`-th on
  void addEvents(std::size_t from, std::size_t move, bool isProtected = false);
  std::size_t placeOf(PictureBlock block); // in Picture::blocks
  std::size_t frameNow();
  void forgetLost(PictureMove& move) const;
  std::size_t toolNow(); // in Picture::tools, from 1; 0: the probe
  PathKind kindOf(MotionKind kind) const;

  Picture picture_;
  World* world_;
  CallKind callKind_;
  BlockNow block_;
  FrameNow frame_;
  std::function<Point3()> here_;
  std::function<bool()> safe_;
  std::map<std::string, std::size_t> places_;  // of blocks
  std::vector<std::optional<PathKind>> calls_; // that are open
  bool on_;
  bool full_ = false;
};

} // namespace dotek::sim
