// Cycles by name (CallCycle) that the cycle language has beside those of macro sets.
#pragma once

#include "ir/Expression.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace dotek::ir {

// Moves nothing. Along each axis of `setting`, system := active system + argument "measured AXIS" - nominal:
// the place that has the coordinate `measured` in the active system gets `nominal` in the system, at once.
inline constexpr std::string_view kSetOffset = "set-offset";
// Moves nothing. Tool offset "tool" gets one of its parts (toolPartText), mm: as a whole it has no wear then.
inline constexpr std::string_view kSetTool = "set-tool";
// What a tool offset holds, mm: a length and a radius, each with the wear that is part of it.
enum class ToolPart : std::uint8_t { Length, LengthWear, Radius, RadiusWear };
inline constexpr ToolPart kToolParts[] = {ToolPart::Length, ToolPart::LengthWear, ToolPart::Radius,
                                          ToolPart::RadiusWear};
std::string_view toolPartText(ToolPart part); // "length", "length wear"
bool isLength(ToolPart part);                 // else of the radius
bool isWear(ToolPart part);
// That a cycle reads it: a variable of the machine whose number no control has, #(kToolTable + 1000 * part +
// tool). Always the whole value of an Assign. What a control has there says its back end.
inline constexpr double kToolTable = 9'000'000;
inline constexpr double kToolPartStep = 1000;
ExpressionPtr toolValue(ToolPart part, const ExpressionPtr& tool, SourceRange range = {});
// Part and number of the offset; nothing: another value.
std::optional<std::pair<ToolPart, ExpressionPtr>> readTool(const Expression& value);
std::optional<std::pair<ToolPart, double>> toolOf(double number); // of a variable
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
// A called cycle that is a program of its own: its place in the list of these programs, and its parameters
// and host inputs by their names. Of its results the one at `index` of its list is in handedBack(index)
// afterwards, a variable with a number that no control has, until the next of these calls.
inline constexpr std::string_view kProgram = "program";
inline constexpr std::string_view kCalledProgram = "called program";
inline constexpr double kHandedBack = 8'000'000;
ExpressionPtr handedBack(std::size_t index, SourceRange range = {});
std::optional<std::size_t> handedBackOf(const Expression& value); // the index; nothing: another value

} // namespace dotek::ir
