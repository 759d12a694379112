// A call of a probing macro as a cycle of the IR: names of its parameters, and what it does to the machine.
// Until cycles have definitions of their own, signatures and this table are what they consist of.
#pragma once

#include "stdlib/MacroSet.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::stdlib {

// What a cycle does beside measuring.
struct CycleFacts {
  bool moves = true;          // the probe moves
  bool returns = true;        // and comes back to where it began; false: it may end elsewhere
  std::array<bool, 3> sets{}; // by Axis: offsets that a System argument changes
  std::optional<bool> power;  // it switches the probe
};
CycleFacts cycleFacts(const MacroSignature& signature);

// The axis along which it measures, of an intent with a signature for each axis; nullopt: it has one for all.
std::optional<ir::Axis> axisOf(const MacroSignature& signature);

// Name of the cycle of the library that says what the program does, if there is one: what it measures, after
// "measure", and the axis of an intent with a signature for each axis: "measure_bore", "measure_web_x".
std::string libraryCycle(const MacroSignature& signature);

// Name of the one for a feature that the probe goes down beside, where an island is in its middle:
// "measure_bore_island" of a boss, whose letters are the same. "": no call has it.
std::string islandCycle(const MacroSignature& signature);

// A role or an output as a name of the cycle language: "first_angle" of "first-angle".
std::string languageName(std::string_view name);

// Name of the parameter that the argument fills, its axis included: "target x", "depth". Of a letter whose
// meaning is in no source: "letter k".
std::string parameterName(const MacroArgument& argument);

// The parameter, by its name, as a message says it of a call: "its size-tolerance", "M1, which raises no
// alarm".
std::string parameterWords(std::string_view parameter);

// The probe moves by the argument; false: it checks, corrects or prints.
bool movesProbe(ArgumentRole role);

// The parameter, by its name, asks for a printout of the package alone: another set, or none, need not have
// it.
bool isPrintout(std::string_view parameter);

} // namespace dotek::stdlib
