// What a run measured, and which offsets it wrote: the table of its report.
#pragma once

#include "ir/Kind.h"
#include "stdlib/MacroSet.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dotek::sim {

// Lengths in mm, angles in degrees; coordinates of the work offset that was active before anything was set.
struct MeasuredValue {
  std::string name;              // "X", "diameter", "width", "angle"
  std::optional<double> nominal; // nothing: no source of the call says it
  double measured = 0;
  ir::Kind kind = ir::Kind::Length;
};

struct Measurement {
  std::uint32_t program = 0; // of the macro; 0: a skip move of the program's own
  std::string title;         // "bore", "touch along X+"
  std::vector<MeasuredValue> values;
};

// A work offset or a tool offset got a value.
struct OffsetWrite {
  std::string name; // "G54 X", "G54.1 P3 Z", "external X", "tool 5 wear"
  double before = 0, after = 0;
  std::uint32_t tool = 0; // whose wear or geometry it is; 0: another offset
};

// What a call of a macro with this signature found. `locals`: its arguments by number, kNull where there is
// none. Nominal is what the call names, else what is measured less the error that was found.
Measurement measurementOf(const stdlib::MacroSignature& signature, std::span<const double> locals,
                          const std::map<stdlib::Output, double>& found);

} // namespace dotek::sim
