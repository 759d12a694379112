// Cutting tools and the tool setter of a machine, docs/part.md. Lengths in mm.
#pragma once

#include "sim/geometry/Point.h"
#include "stdlib/Toml.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace dotek::sim {

// As it is, whatever its offset says: a cylinder with a flat end.
struct CuttingTool {
  std::uint32_t number = 0;
  double length = 0; // from the gauge line of the spindle
  double diameter = 0;
};

// A disc on the table that gives the skip signal when a tool's end pushes it.
struct ToolSetter {
  enum Direction : std::uint8_t { Down, PlusX, MinusX, PlusY, MinusY, kDirections }; // of the tool's motion
  Point3 at; // middle of its upper face, in coordinates of the machine
  double diameter = 0;
  std::array<bool, kDirections> triggers{true, false, false, false, false};
  double preTravel = 0;  // from the touch to the signal
  double overtravel = 0; // how far it may be pushed
};

struct Devices {
  std::optional<std::uint32_t> probeTool; // its number; nothing: every tool that is not in `tools`
  std::vector<CuttingTool> tools;         // each number once
  std::optional<ToolSetter> setter;

  const CuttingTool* find(std::uint32_t number) const; // nullptr: it is none of them
};

// Where the end of a tool meets the setter on a straight path.
struct SetterTouch {
  double share = 0;
  ToolSetter::Direction direction = ToolSetter::Down; // in which the tool pushes
  bool atStart = false;                               // it touches already, and does not move away
  Point3 point, normal;                               // of the setter
};
std::optional<SetterTouch> firstTouch(const ToolSetter& setter, double toolRadius, const Point3& from,
                                      const Point3& to);

// [[tool]] and [tool_setter] of a machine's file, and `tool` of its [probe].
Devices readDevices(const stdlib::TomlDocument& document, const stdlib::TomlTable& root);

} // namespace dotek::sim
