// Tolerances of a call that a macro has no letter for, or not together with the others: what is compared
// after it instead, by the target itself.
#pragma once

#include "ir/Statement.h"
#include "stdlib/MacroSet.h"

#include <functional>
#include <string_view>
#include <vector>

namespace dotek::backends {

// An alarm where `error` is above `limit`; both count sizes, mm or degrees. Results of the macro are
// variables of the machine in `error`.
struct Tolerance {
  ir::ExpressionPtr error, limit; // never null
  std::string_view text;          // of the alarm
};

// Where the source expects the feature of the cycle along the axis, work coordinates; nullptr: not known.
using ExpectedAlong = std::function<ir::ExpressionPtr(const ir::CallCycle& cycle, ir::Axis axis)>;

// Takes the tolerances that `signature` has no letter for, or that `macros` refuses beside another letter of
// the call, its work offset included, out of the cycle's arguments; they come in the order in which macros
// compare them: the error itself, size, position, angle. One stays where what it compares is no documented
// result of the macro, or where `expected` does not know.
std::vector<Tolerance> takeTolerances(ir::CallCycle& cycle, const stdlib::MacroSet& macros,
                                      const stdlib::MacroSignature& signature, const ExpectedAlong& expected);

} // namespace dotek::backends
