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

// Variables and labels exist, names of labels are unique, each label is placed once per list and jumps stay
// in their list, what a statement needs is there, axes and frames agree with their statement, kinds do not
// mix (Number mixes with all; Length times or divided by anything is free), null is only where it may (a
// word, an assignment, IsNull, NullAsZero, ValueOr), checks move, switch and measure nothing and do not
// return, constants are finite. In the order of the statements; of one statement all that is found, of a tree
// with a hole that alone.
std::vector<Violation> verify(const Cycle& cycle);

} // namespace dotek::ir
