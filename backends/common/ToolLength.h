// The number of the tool offset in blocks that are copied: H0 takes the tool's length away, and the next move
// goes down by as much.
#pragma once

#include "ir/Cycle.h"
#include "stdlib/Control.h"
#include "support/Diagnostics.h"

#include <map>
#include <vector>

namespace dotek::backends {

struct LengthOffset {
  std::size_t at = 0; // statement of the body
  const ir::Word* word = nullptr;
  bool always = false; // no way through the body leads past it
};

// H of the blocks that put a tool length in force (G43).
std::vector<LengthOffset> lengthOffsets(const ir::Cycle& cycle, const stdlib::Control& control);
// Whether the values that the program is called with tell the number: arguments alone, which the body leaves
// as they are.
bool isOfArguments(const ir::Cycle& cycle, const ir::ExpressionPtr& number);
// Reports a number that the values fixed make 0 or less, or one that `target` does not have. `cycle`: they
// are not in it yet; `control`: the source's.
void refuseNoLength(const ir::Cycle& cycle, const std::map<ir::VariableId, double>& fixed,
                    const stdlib::Control& control, const stdlib::Control& target, Diagnostics& diagnostics);

} // namespace dotek::backends
