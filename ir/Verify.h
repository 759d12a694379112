// What holds of every cycle that a pass hands on.
#pragma once

#include "ir/Cycle.h"

#include <string>
#include <vector>

namespace dotek::ir {

struct Violation {
  SourceRange range;
  std::string message;     // lower case, source in backticks
  bool mixedKinds = false; // the source's own mistake (a length plus a work offset); else a defect of Dotek
};

// Variables and labels exist, each label is placed once per list and reached jumps stay in their list, axes
// and frames agree with their statement, kinds do not mix (Number mixes with all; Length times or divided by
// anything is free), null stands only where it may, checks hold no motion, constants are finite.
std::vector<Violation> verify(const Cycle& cycle);

} // namespace dotek::ir
