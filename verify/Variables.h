// What programs of macro B take from outside: arguments, common variables, signals of the machine; and values
// for them. The rule is in docs/verify.md.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "verify/Random.h"

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace dotek::verify {

// What a variable is used for, as far as the text shows it; a later one wins.
enum class VariableUse : std::uint8_t {
  Length,      // or nothing that is known
  Size,        // a length above 0
  Angle,       // degrees
  Feed,        // above 0
  Whole,       // chooses: an index, a code, a number of passes
  ToolOffset,  // a number of the tool table, or of a tool
  Extended,    // P of G54.1
  SystemIndex, // 1 to 6 are G54 to G59
  System,      // 54 to 59
  Signal,      // 0 or 1
};

struct ProgramVariable {
  std::uint32_t number = 0;
  VariableUse use = VariableUse::Length;
  bool local = false; // of the first program
  bool askedForNull = false;
  std::set<double> constants;         // that it is compared with
  std::set<std::uint32_t> comparedTo; // variables, by number, of the same conditions
};

// Of the first program the locals, and of all programs the common variables and signals, that may be read
// before the file has written them; by number. What the sets' macros need is none of
// them, nor, where there are two sets, what they use: a translation may keep other values there. A computed
// number
// #[c+..] with a common variable c stands for c and the nine after it.
std::vector<ProgramVariable> variablesOf(const ir::ProgramFile& file, const stdlib::Control& control,
                                         const std::vector<const stdlib::MacroSet*>& sets);
// Variables that calls of the set overwrite, read or leave results in.
bool usesVariable(const stdlib::MacroSet& set, std::uint32_t number);
// Those that have to be set before a call: feed, calibration, what the set's own text wants.
bool needsVariable(const stdlib::MacroSet& set, std::uint32_t number);

// Multiples of 0.001; nothing: null. `attempt`: values before that checks have rejected; the more, the more
// often it lies between the constants.
std::optional<double> drawValue(const ProgramVariable& variable, std::uint32_t attempt, Random& random);
// The `index`-th edge of the variable; they repeat.
std::optional<double> edgeValue(const ProgramVariable& variable, std::uint64_t index);

} // namespace dotek::verify
