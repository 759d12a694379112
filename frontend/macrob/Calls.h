// Macro and subprogram calls, which are NC words: what they call and what each argument sets.
#pragma once

#include "frontend/macrob/Ast.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dotek::frontend::macrob {

enum class CallKind : std::uint8_t {
  Simple,     // G65
  AfterMoves, // G66
  EachBlock,  // G66.1
  Off,        // G67
  Subprogram, // M98
  Return,     // M99
};

struct CallArgument {
  const nc::Word* word = nullptr;
  std::uint32_t variable = 0; // local that it sets; 0: there is no such set of I J K
  // I, J or K that does not follow its predecessor in the alphabet, so that it begins the next set.
  bool outOfOrder = false;
};

// A view of `words`, valid as long as they are.
struct Call {
  CallKind kind = CallKind::Simple;
  const nc::Word* code = nullptr;
  const nc::Word* program = nullptr;    // P; of a return the number of the block to go on at
  const nc::Word* repeat = nullptr;     // L
  const nc::Word* block = nullptr;      // Q of M98: the number of the block to begin at
  std::vector<CallArgument> arguments;  // of G65, G66, G66.1, in the order of the text
  std::vector<const nc::Word*> refused; // G, N, O, further P and L: no arguments
  std::vector<const nc::Word*> before;  // words before the code
};

// The call of an NC block; nullopt: it has none.
std::optional<Call> callOf(const Words& words);
// The program that it names by a number, rounded down, 1 to 99999999; nullopt: it names none, or computes it.
std::optional<std::uint32_t> calledProgram(const Call& call);

// Value of a number without brackets; nullopt: something else. Of a word, too.
std::optional<double> literal(const Expression& expression);
std::optional<double> literal(const nc::Word& word);

// The block has this code as a literal: `G31`, `M99`.
const nc::Word* findCode(const Words& words, char letter, double code);

} // namespace dotek::frontend::macrob
