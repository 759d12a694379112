// Kinds of values, frames of coordinates, axes: the vocabulary of the IR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dotek::ir {

// X(id, text form, unit)
#define DOTEK_KINDS(X)                                                                                       \
  X(Number, "number", "")   /* no kind known: constants, work variables; mixes with every kind */            \
  X(Length, "length", "mm") /* coordinate, travel, diameter, radius */                                       \
  X(Angle, "angle", "degrees")                                                                               \
  X(Feed, "feed", "mm/min")                                                                                  \
  X(Count, "count", "")                                                                                      \
  X(Ratio, "ratio", "")                                                                                      \
  X(WorkOffset, "work-offset", "") /* G number of a work system: 54 to 59 */                                 \
  X(ToolOffset, "tool-offset", "")                                                                           \
  X(Flag, "flag", "")                                                                                        \
  X(Text, "text", "")

enum class Kind : std::uint8_t {
#define DOTEK_KIND(id, text, unit) id,
  DOTEK_KINDS(DOTEK_KIND)
#undef DOTEK_KIND
};

std::string_view kindName(Kind kind);
// "mm", "degrees", "mm/min", "".
std::string_view kindUnit(Kind kind);

enum class Axis : std::uint8_t { X, Y, Z };
inline constexpr Axis kAxes[] = {Axis::X, Axis::Y, Axis::Z};
constexpr std::size_t indexOf(Axis axis) {
  return static_cast<std::size_t>(axis);
}
constexpr char letterOf(Axis axis) {
  return "XYZ"[indexOf(axis)];
}

// What a coordinate counts from. No frame is a default.
enum class Frame : std::uint8_t {
  Machine,
  Work,    // a work system: the active one, or the one that the coordinate names
  Start,   // position at the cycle's entry, in the active work system (GibbsCAM X and Y)
  Retract, // Z from the retract plane of the operation (GibbsCAM Z)
  Here,    // position before the statement (EasyProbe travel, G91)
};
std::string_view frameName(Frame frame);

// Which point of the probe a coordinate means.
enum class ProbePoint : std::uint8_t { Centre, Lowest, Contact };
std::string_view pointName(ProbePoint point);

} // namespace dotek::ir
