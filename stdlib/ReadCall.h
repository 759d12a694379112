// A call of a probing macro as the signatures of a set read it. Whoever lifts, translates, runs or judges a
// call asks here.
#pragma once

#include "stdlib/MacroSet.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

// Why a call has no single meaning.
enum class CallRefusal : std::uint8_t {
  None,
  UnknownProgram, // the set has no macro of this number
  RepeatedLetter, // a letter is given twice
  UnknownLetter,  // no signature of the program has the letter
  Excluded,       // the macro does not take these letters together
  Missing,        // the nearest signatures need more letters
  Ambiguous,      // every letter is known, and they belong to different readings: XY of one surface
};

// One argument that the call gives.
struct ReadArgument {
  const MacroArgument* meaning = nullptr; // of the signature, never null
  std::size_t at = 0;                     // index into the letters of the call
};

// A view of the set, valid as long as it is.
struct CallReading {
  CallRefusal refusal = CallRefusal::None;
  const MacroSet* set = nullptr; // never null
  std::uint32_t program = 0;
  std::string letters;                       // of the call, in its order
  const MacroSignature* signature = nullptr; // the only one that fits; nullptr: refused
  std::vector<ReadArgument> arguments;       // in the order of the call; empty where it is refused
  std::size_t at = std::string::npos;        // RepeatedLetter, UnknownLetter: index of the letter
  const RefusedLetters* excluded = nullptr;  // Excluded: the rule that the call breaks
  std::string missing;                       // Missing: "S", "X or Y or Z", "S and I"

  char letter() const { return at < letters.size() ? letters[at] : '\0'; } // that `at` names; 0: none
  // The argument with the role, `axis` aside for roles that state none; nullptr: the call does not give it.
  const ReadArgument* find(ArgumentRole role, ir::Axis axis = ir::Axis::X) const;
};

// Reads a call of `program` with these letters, G, P and repeats aside. An argument that may be empty when
// the program runs counts as given.
CallReading readCall(const MacroSet& set, std::uint32_t program, std::string_view letters);

// What was refused, as the fact of a message: "program `9023` of `easyprobe` has no argument `W` that Dotek
// knows". "" where nothing was.
std::string refusalText(const CallReading& reading);

// "the call of program `9023` of `easyprobe` lacks S"
std::string lacks(const CallReading& reading, std::string_view missing);

// Some signature of the program has the letter.
bool takesLetter(const MacroSet& set, std::uint32_t program, char letter);

} // namespace dotek::stdlib
