// Private to Target*.cpp: what a macro does in one call, a cycle does in several touches.
#pragma once

#include "verify/Record.h"

namespace dotek::targets {

// The record of a cycle with one measure for each call of the source: the touches that the call has, with the
// moves between them. As it is where the two do not fit.
verify::Record joinedMeasures(const verify::Record& source, const verify::Record& ran, double ballRadius);

} // namespace dotek::targets
