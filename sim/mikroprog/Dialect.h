// The language of controls by Mikronex on the machine that all controls share: what its codes do there, and
// what its words for jumps, calls, records and stops lead to. Nothing else of the simulator knows of it.
// Facts and grades: docs/mikroprog.md.
#pragma once

#include "ir/Program.h"
#include "sim/machine/Bytecode.h"
#include "sim/machine/Dialect.h"
#include "sim/machine/Machine.h"
#include "stdlib/Control.h"
#include "stdlib/MikroprogControl.h"
#include "support/Source.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
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

// Programs that G28 may run, by the names of their files.
using OtherPrograms = std::map<std::string, const ir::Program*, std::less<>>;
// Names of the files that the program runs, in the order of the text, each once.
std::vector<std::string> programsRunBy(const ir::Program& program, const stdlib::MikroprogControl& control);

// The program as it runs; program, profile and the others outlive it. Nothing is refused here: what cannot
// run ends the run where it is reached. X of a lathe becomes a radius.
Bytecode compile(const ir::Program& program, const Profile& profile, const SourceMap& sources,
                 const OtherPrograms& others = {});

// P parameters are common variables of the machine, one number higher: #0 is no variable.
constexpr std::uint32_t variableOf(std::uint32_t parameter) {
  return parameter + 1;
}
constexpr std::uint32_t parameterOf(std::uint32_t variable) {
  return variable - 1;
}
inline constexpr std::uint32_t kAccumulator = 90; // P90: of conditions and files

// What the control keeps beside the machine's own state, as parameters that no program can name; without a
// value it is not known, or off.
enum Kept : std::uint32_t {
  kRadius = 1000,    // 1: X is a radius (G24)
  kShift,            // code of the shift in force: 51 to 55
  kSurface,          // greatest speed of the G96 in force
  kMotionLost,       // 1: since a G33 no motion is known to be in force
  kCondition = 1100, // and the number of O: 1 where it holds, 0 where not
  kStored = 1200,    // of G52 and on, ten a shift: its axes in the order of kAxisLetters
  kLastKept = 1299
};
constexpr std::uint32_t storedShift(std::uint32_t code, std::size_t axis) {
  return kStored + 10 * (code - 52) + static_cast<std::uint32_t>(axis);
}
inline constexpr std::uint32_t kLastParameter = 999; // that a program can name

// What a user may set before the program begins: "P5", "O1", "G52.Z" (of a lathe X as a diameter). false: it
// is none of these, or the machine does not have it.
bool preset(Machine& machine, const Profile& profile, std::string_view name, double value);

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
