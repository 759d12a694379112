// Where the tool is and what is in force, in the order of the text. What is not certain is unknown: after
// a jump target, a contact, a change of the system, a code that nobody knows.
#pragma once

#include "frontend/mikroprog/Reading.h"

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace dotek::frontend::mikroprog {

struct MotionState {
  std::array<std::optional<double>, 3> at; // X, Y, Z in mm, X of a lathe as a radius; nothing: not known
  std::optional<bool> absolute = true;     // G90
  std::optional<bool> radius = false;      // G24
  std::string motion = "rapid";            // the function of the motion group in force
  std::string plane;                       // "XZ"; "": not known
  bool feed = false;                       // some F was given
  bool compensated = false;                // G41, G42
  std::optional<double> feedValue;         // of the last F
  std::optional<double> speed;             // of the last S
  std::optional<bool> turning = false;     // M3, M4
  char direction = 0;                      // '3', '4': of the last of them; 0: not known
  bool reversed = false;                   // turned round, and less than 5 s of G4 since
  double waited = 0;                       // s, since then
  std::optional<bool> perRevolution = false, constantSpeed = false, coolant = false; // G95, G96, M8
  const stdlib::MikroprogFunction* shift = nullptr;                                  // G51 to G55
  bool joined = false;                                                               // M40

  // By how much the block moves along the axis ('X', 'Y', 'Z'), mm; nothing: not known.
  std::optional<double> travel(const Line& line, char axis, const stdlib::MikroprogControl& control) const;
};

// Calls `visit` for each block that could be read, with what is in force in it and where the tool is
// before it.
void walkMotion(const Reading& reading,
                const std::function<void(const Block& block, const MotionState& state)>& visit);

// The tool cuts: a feed move, an arc, a thread, a cycle.
bool isCut(const Block& block, const MotionState& state, const stdlib::MikroprogControl& control);
// The block has a word of an axis.
bool hasAxisWord(const Block& block, const stdlib::MikroprogControl& control);

// All codes of the block are of the motion group or take no address.
bool onlyMoves(const Block& block);

} // namespace dotek::frontend::mikroprog
