// The setup of a run, carried out on the machine before the program begins.
#pragma once

#include "project/ProgramLibrary.h"
#include "project/Session.h"
#include "sim/geometry/Probe.h"
#include "sim/machine/Machine.h"
#include "stdlib/Setup.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::sim {

using stdlib::Setup;

// Tool lengths, the tool in the spindle and work offsets. `part`: where the part is meant to be; nothing:
// there is none. false: reported.
bool prepare(const Setup& setup, const std::optional<std::array<double, 3>>& part, Machine& machine,
             Diagnostics& diagnostics);

// Puts G54 (0) to G59 (5) in force before the program. false: reported.
bool activate(std::uint32_t system, Machine& machine, Diagnostics& diagnostics);

// Where the machine is before the program, with the tool's end at `setup.at` of the active system; nothing:
// the setup does not say. `probe`: the length of one that has no number, and is in the spindle where the
// setup names no tool.
std::optional<Position> startOf(const Setup& setup, const Machine& machine, double probe = 0);

// Whether X, Y and Z are within the machine's travel where `setup.at` puts the tool; one that says nothing
// is. false: reported as what `saidBy` says ("--at").
// `leftOut`: the file of the machine says where the zero of that system is, and it does not
// count.
bool startsWithinTravel(const Setup& setup, double probe, std::string_view saidBy, bool leftOut,
                        const MachineLimits& limits, const Machine& machine, Diagnostics& diagnostics);

// Whether the arguments of `setup.call` are letters with their values, as a block has them; false: reported,
// with what was meant.
bool isCall(const Setup& setup, Diagnostics& diagnostics);

// A main program that calls O`number` with the arguments of `setup.call`. Where the setup names a tool its
// length is in force (G43), and the machine stays where it is.
std::string callingProgram(const Setup& setup, std::uint64_t number, const Machine& machine,
                           const Position& start);

} // namespace dotek::sim
