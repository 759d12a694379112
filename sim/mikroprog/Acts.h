// What functions do for which the shared machine has no code: shifts, threads, cycles, the reference run,
// conditions, outputs. Private to this room.
#pragma once

#include "sim/machine/Bytecode.h"
#include "sim/mikroprog/Dialect.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>

namespace dotek::sim::mikroprog {

// A function with the words of its block.
struct Act {
  Act(const stdlib::MikroprogControl& of, const stdlib::MikroprogFunction& with)
      : control(of), function(with) {
    words.fill(kNoCell);
  }
  bool has(char letter) const { return words[static_cast<std::size_t>(letter - 'A')] != kNoCell; }

  const stdlib::MikroprogControl& control; // outlives the code
  const stdlib::MikroprogFunction& function;
  std::array<std::uint32_t, 26> words{}; // cells by letter
};

// Whether the words of a block are those of the function: a cycle, a thread, a local system.
bool takesWords(std::string_view function);

Action actionOf(const Act& act); // of a function that takes words, of G50, G52 to G55, G96, G98, M20, M21
// Puts into the cell 1 where the condition holds, else 0; one that nobody knows ends the run.
Action askCondition(const stdlib::MikroprogControl& control, std::uint32_t number, std::uint32_t cell);
Action stopIf(const stdlib::MikroprogControl& control, std::uint32_t number, std::string text); // M1
Action endSurfaceSpeed();                                                                       // a new S
Action dwellThen(std::uint32_t seconds);              // the cell of a time that is over
Action writeText(std::string file, std::string text); // M29
Action keep(Kept what, double value);
Action checkMotion(); // a move without a code of its own, in a program with G33
// In incremental mode the run ends here, unless X is a radius; `said`: that mode is in the block.
Action checkDiameters(bool said);
Action checkRadius(std::string why); // under G24 the run ends here
Action checkNoShift();               // G92 under a shift

} // namespace dotek::sim::mikroprog
