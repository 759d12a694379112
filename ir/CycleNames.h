// Cycles by name (CallCycle) that the cycle language has beside those of macro sets.
#pragma once

#include <string_view>

namespace dotek::ir {

// Moves nothing. Along each axis of `setting`, system := active system + argument "measured AXIS" - nominal:
// the place that has the coordinate `measured` in the active system gets `nominal` in the system, at once.
inline constexpr std::string_view kSetOffset = "set-offset";
// Moves nothing. Tool offset "tool" gets "length" or "radius", mm.
inline constexpr std::string_view kSetTool = "set-tool";
// Moves nothing. Each argument is kept under its name for a later run.
inline constexpr std::string_view kKeep = "keep";
// Moves nothing. A line of the protocol: "measured", and "nominal" and "tolerance" where they are stated. The
// name of the line is the text of the Comment before it.
inline constexpr std::string_view kReport = "report";
// Moves nothing; the last statement of a cycle that has results. Each argument is one of them by its name.
inline constexpr std::string_view kResults = "results";
// A surface along the axis of the call, as Measure: "target AXIS", and how it is searched: "overtravel", mm,
// "once" (1: one touch, at one feed), "miss" (1: where nothing is found the program goes on, with the result
// probe-error 1 instead of 0).
inline constexpr std::string_view kSurface = "surface";
// A surface along "direction x", "direction y", "direction z" (of any length), "travel" from the ball's
// centre to the expected contact, mm; the others as for a surface. Results: the contact in x, y and z, and
// main: measured less expected along the direction.
inline constexpr std::string_view kSurfaceAlong = "surface-along";

} // namespace dotek::ir
