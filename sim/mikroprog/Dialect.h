// The language of controls by Mikronex on the machine that all controls share: what its codes do there, and
// what its words for jumps, calls, records and stops lead to. Nothing else of the simulator knows of it.
// Facts and grades: docs/mikroprog.md.
#pragma once

#include "ir/Program.h"
#include "sim/machine/Bytecode.h"
#include "sim/machine/Dialect.h"
#include "stdlib/Control.h"
#include "stdlib/MikroprogControl.h"
#include "support/Source.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::sim::mikroprog {

// The control as its machine sees it. A code that is missing here, since no source says enough of it, ends a
// run as inconclusive where it is reached: to follow it is a line in Dialect.cpp.
struct Profile {
  explicit Profile(const stdlib::MikroprogControl& control); // outlives the profile

  const stdlib::MikroprogControl& control;
  stdlib::Control machine;
  Dialect dialect;
};

// The program as it runs; program and profile outlive it. Nothing is refused here: what cannot run ends the
// run where it is reached. X of a lathe becomes a radius.
Bytecode compile(const ir::Program& program, const Profile& profile, const SourceMap& sources);

// P parameters are common variables of the machine, one number higher: #0 is no variable.
constexpr std::uint32_t variableOf(std::uint32_t parameter) {
  return parameter + 1;
}
constexpr std::uint32_t parameterOf(std::uint32_t variable) {
  return variable - 1;
}
inline constexpr std::uint32_t kAccumulator = 90; // P90: of conditions and files

// What a G31 is, by the blocks that it leads to.
enum class SkipUse : std::uint8_t {
  Protected, // contact leads to a stop, none goes on
  Search,    // contact goes on, none leads to a stop
  Neither,
  Blind, // no L with a block of the program
};
struct SkipMoveUse {
  std::size_t statement = 0; // of the body
  SkipUse use = SkipUse::Neither;
  std::optional<std::size_t> stop = {}; // of one that protects or searches: where it leads to a stop
};
// Of each G31, in the order of the text.
std::vector<SkipMoveUse> skipMoves(const ir::Program& program, const stdlib::MikroprogControl& control);

// The text beside the block of a statement, which the operator reads at a stop; "": none.
std::string textBeside(const ir::Program& program, std::size_t statement);

// Functions of the blocks before the first one with an axis: "absolute", "plane-xy", in the order of the
// text.
std::vector<std::string> functionsFirst(const ir::Program& program, const stdlib::MikroprogControl& control);

// ---- private to this room

// A word's constant as a number of a code, a block, a condition. nullopt: it is none, or not constant.
std::optional<std::uint32_t> wholeOf(const ir::Word& word);
const ir::Word* find(const ir::NcBlock& block, char address); // nullptr: not there

} // namespace dotek::sim::mikroprog
