// Subprograms within the text of a program.
#include "sim/machine/Run.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace dotek::sim {

bool Run::callPlace(std::uint32_t entry) {
  Frame frame = machine_.frame();
  frame.macro = false;
  if (!machine_.enter(frame)) return false;
  Level level;
  level.routine = &code_.routineOf(entry);
  level.caller = place_;
  levels_.push_back(std::move(level));
  place_ = entry;
  return true;
}

// Rounds with the same machine follow each other for ever, unless a probe's signal differs. States are kept
// farther and farther apart, so a loop of any length is found in a few times its length.
bool Run::round() {
  constexpr std::uint64_t kFirst = 1000;
  constexpr std::ptrdiff_t kSecondsFromEnd = 2; // of a snapshot
  if (++rounds_ < kFirst || machine_.hasSkipSignal()) return true;
  if (keptRound_ != 0 && rounds_ < 2 * keptRound_ && place_ != roundPlace_) return true;
  std::vector<double> now = machine_.snapshot();
  *(now.end() - kSecondsFromEnd) = 0; // no condition of the control asks for the time
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  if (place_ == roundPlace_ && levels_.size() == roundLevels_ &&
      std::equal(now.begin(), now.end(), roundState_.begin(), roundState_.end(), same))
    return machine_.overLimit(
        "the program comes back here with the machine as it was before, so it goes round for ever");
  if (keptRound_ != 0 && rounds_ < 2 * keptRound_) return true;
  keptRound_ = rounds_;
  roundPlace_ = place_;
  roundLevels_ = levels_.size();
  roundState_ = std::move(now);
  return true;
}

bool Run::leavePlace(const std::string& fault) {
  if (levels_.size() == 1) return machine_.raiseUnnumbered(fault);
  place_ = levels_.back().caller + 1;
  leaveLevel(levels_.back());
  levels_.pop_back();
  return true;
}

} // namespace dotek::sim
