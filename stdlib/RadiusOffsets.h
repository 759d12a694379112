// Where a control has the radii of its tools.
#pragma once

#include "stdlib/Control.h"

#include <string_view>

namespace dotek::stdlib {

// A range of `[[state]]` with one of these titles holds the radii of the offsets from 1 on.
inline constexpr std::string_view kRadiusGeometryTitle = "radius offsets of the tools: geometry";
inline constexpr std::string_view kRadiusWearTitle = "radius offsets of the tools: wear";

// Of offset 0, as SystemVariables::toolWear. Neither: no profile says it.
struct RadiusOffsets {
  std::optional<int> geometry, wear;
};
RadiusOffsets radiusOffsets(const Control& control);

} // namespace dotek::stdlib
