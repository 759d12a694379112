// Plain moves of a long program that lint need not keep, since no finding can depend on them. A CAM prints
// little else.
#pragma once

#include "stdlib/MikroprogControl.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace dotek::frontend::mikroprog {

// How many of its lines a program keeps.
struct Keeping {
  // Letters that a plain move may have; "": every line is kept.
  std::string_view axes = "";
  std::size_t from = 0; // bytes of a text of which lines are left out
};

// By line whether it may be left out; empty: none. Such a line has nothing but an N, G0 or G1 or neither,
// axes with a number and an F that is right, each once, and so have the lines before and after it, with the
// same letters but F; before a G1 may be an arc or a feed by a parameter, too, and P1=5 between them counts
// as no line. One with an F is left out only where both have one. So what is in force and where the tool is
// are the same at all moves that are kept. Nothing is left out where block numbers do not rise, and no line
// whose number is after an L.
std::vector<bool> leftOut(const std::vector<std::string_view>& lines, std::string_view axes);

// Whether nothing of a move like these is wrong on the control, whatever its numbers are.
bool takesPlainMoves(const stdlib::MikroprogControl& control);

} // namespace dotek::frontend::mikroprog
