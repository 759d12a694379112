// Where a call of a probing macro expects surfaces, by its arguments alone.
#pragma once

#include "stdlib/MacroSet.h"
#include "verify/Record.h"

#include <span>
#include <vector>

namespace dotek::verify {

// The signature that the call's arguments fit; nullptr: none, or several. `locals` by number, kNull where
// there is no argument.
const stdlib::MacroSignature* signatureOf(const stdlib::MacroSet& set, std::uint32_t program,
                                          std::span<const double> locals);

// Touches of one call, in the order of its axes: a surface one, a bore or a boss four, a pocket or a web two,
// the angle of a face two. Empty where the call states none, or not enough is known. `start`: where the
// stylus's lowest point is, active work system.
std::vector<Touch> nominalTouches(const stdlib::MacroSignature& signature, std::span<const double> locals,
                                  const sim::Point3& start, double ballRadius);

} // namespace dotek::verify
