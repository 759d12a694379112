// Arguments that say how large an error may be.
#pragma once

#include "stdlib/MacroSet.h"

namespace dotek::stdlib {

// A tolerance, an upper limit, a null band. No source says what one below 0 does.
constexpr bool isLimit(ArgumentRole role) {
  return role == ArgumentRole::SizeTolerance || role == ArgumentRole::PositionTolerance ||
         role == ArgumentRole::AngleTolerance || role == ArgumentRole::UpperLimit ||
         role == ArgumentRole::NullBand;
}

} // namespace dotek::stdlib
