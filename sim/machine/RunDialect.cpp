// Subprograms within the text of a program.
#include "sim/machine/Run.h"

namespace dotek::sim {

bool Run::callPlace(std::uint32_t entry) {
  Frame frame = machine_.frame();
  frame.macro = false;
  if (!machine_.enter(frame)) return false;
  Level level;
  level.routine = levels_.back().routine;
  level.caller = place_;
  levels_.push_back(std::move(level));
  place_ = entry;
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
