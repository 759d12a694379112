// Writes a cycle whose values are all known as a program of a control by Mikronex (docs/mikroprog.md).
#pragma once

#include "backends/common/EmittedLine.h"
#include "ir/Cycle.h"
#include "stdlib/MikroprogControl.h"
#include "support/Diagnostics.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::backends::mikroprog {

// What a measurement that sets an offset becomes.
enum class Datum : std::uint8_t {
  SetPosition, // G92: the contact gets its coordinate in the active system
  Operator,    // a stop: the operator enters the shift
};

struct NamedValue {
  std::string name;
  double value = 0;
  std::string from; // "default", "--set", "host input"
};

// A surface that the path of the source touches along one axis; mm, in the coordinates of the source.
struct DrawnSurface {
  ir::Axis axis = ir::Axis::X;
  bool upward = false;             // the probe moves to greater coordinates
  double face = 0;                 // coordinate of the surface
  std::array<double, 3> contact{}; // where the ball is then: its centre in X and Y, its lowest point in Z
};

struct EmitOptions {
  const stdlib::MikroprogControl& control;
  std::string fileName; // of records, without ending: "SURFACEX"
  Datum datum = Datum::SetPosition;
  std::set<std::uint32_t> assumed;     // questions of --assume
  std::map<std::string, double> hosts; // stdlib/HostInputs.h: mm, mm/min
  bool lengthToCentre = false;         // the tool length ends at the ball's centre, else at its lowest point
  std::vector<NamedValue> values;      // of the parameters, for the header
  bool cycleFile = false;              // the source is a file of the cycle language, for messages
  // Asked at most once; empty: the source draws no path.
  std::function<std::vector<DrawnSurface>()> drawnSurfaces = {};
};

// Whether a move or a measurement of the cycle needs an axis Y.
bool movesY(const ir::Cycle& cycle);

// Host inputs that a program for this control needs and `hosts` does not give, in the order of the table.
std::vector<std::string> missingHosts(const ir::Cycle& cycle, const stdlib::MikroprogControl& control,
                                      const std::map<std::string, double>& hosts);

// Name of a file in the form that DOS takes, without ending: "SURFACEX".
std::string shortFileName(const std::string& cycle);

// The program. `cycle` is folded with a value for each parameter and host input; its checks have passed.
// nullopt where the control cannot say something: reported.
std::optional<std::vector<EmittedLine>> emit(const ir::Cycle& cycle, const EmitOptions& options,
                                             Diagnostics& diagnostics);

} // namespace dotek::backends::mikroprog
