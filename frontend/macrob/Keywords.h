// The words of macro statements, and how a run of letters falls into them.
#pragma once

#include <cstdint>
#include <string_view>

namespace dotek::frontend::macrob {

enum class WordKind : std::uint8_t {
  If,
  Then,
  Goto,
  While,
  Do,
  End,
  And,
  Or,
  Xor,
  Mod,
  Relation,
  Function,
  Port,
  Print,
  SetNames,
  Address, // a single letter
};

struct WordMatch {
  WordKind kind = WordKind::Address;
  std::size_t length = 1; // letters
};

// The word that begins `letters` (capitals without blanks, at least one): the longest keyword, else one
// address.
WordMatch wordAt(std::string_view letters);

// A function, an operator or a relation, and nothing else.
bool isExpressionWord(std::string_view letters);

// Local variable of an argument's letter (A is 1, X is 24); 0: the letter is none.
std::uint32_t argumentVariable(char letter);

} // namespace dotek::frontend::macrob
