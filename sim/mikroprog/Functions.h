// Tables of functions: what a block compiler asks of them. Private to this room.
#pragma once

#include "sim/machine/Cells.h"
#include "stdlib/MikroprogControl.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace dotek::sim::mikroprog {

inline constexpr std::string_view kJumpLetters =
    "LOH@"; // what jumps, conditions and files take: nothing for the machine
inline constexpr std::uint32_t kStateOfProgram = 25; // Q: what a program finds that another one runs

// After the words of the block.
enum class Flow : std::uint8_t {
  None,
  Jump,
  JumpIf,
  Call,
  Return,
  Position,
  Value,
  Text,
  Stop,
  StopIf,
  Wait,
  Reference,
  Output,
  Program, // another one
  Macro,   // M61.MAC
  End,     // of a program that another one runs
};

Flow flowOf(std::string_view function);
std::string macroFile(const stdlib::MikroprogFunction& function); // of M61 to M68
// In force for the words of its own block.
bool isSetting(std::string_view function);
// Moves and decides nothing.
bool isQuiet(std::string_view function);
// Letters of functions that the machine has no words for.
std::string_view lettersOf(std::string_view function);
// Why no run goes on at the function.
std::string whyNotFollowed(const stdlib::MikroprogFunction& function);
bool isAxis(char letter);

} // namespace dotek::sim::mikroprog
