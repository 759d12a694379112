// Where the probe stands before each statement of a body, as far as the moves tell.
#pragma once

#include "ir/Cycle.h"

#include <array>
#include <vector>

namespace dotek::ir {

// One axis. Work: coordinate `value` in the active work system. Start: entry position plus `value`. Unknown
// where paths disagree, or an opaque block or a variable that changed since stands between.
struct AxisPosition {
  enum class State : std::uint8_t { Unknown, Work, Start };
  State state = State::Start;
  ExpressionPtr value; // null pointer for Unknown
};
using Position = std::array<AxisPosition, 3>; // by Axis

// One entry for each statement of `cycle.body`: before it. Unreachable statements: Unknown. A measurement
// comes back to where it began. A change of the work system, the machine frame and the retract frame give
// Unknown (Z of a retract move: Unknown, the axes beside it stay).
std::vector<Position> positions(const Cycle& cycle);

// The last measurement before each statement of the body, on every path; nullptr: none, or paths disagree.
std::vector<const Measure*> lastMeasurements(const Cycle& cycle);

} // namespace dotek::ir
