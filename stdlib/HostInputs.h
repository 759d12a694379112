// Host inputs: values that the CAM knows and the macro does not (`--host NAME=VALUE`, `host` of a job).
// Numbers are mm, degrees, mm/min.
#pragma once

#include <algorithm>
#include <iterator>
#include <string_view>

namespace dotek::stdlib {

inline constexpr std::string_view kHostInputs[] = {
    "clearance", // main clearance plane, the CP1 of a Prog
    "overtravel",  "retract",     "return_feed", "start_x", "start_y", "start_z",
    "tool_number", // pocket or program number of the tool; jobs give it as tool.number
    "tool_offset", "tool_radius",
};

constexpr bool isHostInput(std::string_view name) {
  return std::find(std::begin(kHostInputs), std::end(kHostInputs), name) != std::end(kHostInputs);
}

} // namespace dotek::stdlib
