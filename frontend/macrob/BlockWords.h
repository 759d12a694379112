// The words of one NC block, for checks.
#pragma once

#include "frontend/macrob/Ast.h"

#include <string>
#include <string_view>

namespace dotek::frontend::macrob {

// The first word of this letter that has a value; nullptr: there is none.
const nc::Word* findWord(const Words& words, char letter);
// The first word of any of these letters, with or without a value; nullptr: there is none.
const nc::Word* findAnyOf(const Words& words, std::string_view letters);
inline bool hasAny(const Words& words, std::string_view letters) {
  return findAnyOf(words, letters) != nullptr;
}

// `,C` `,R` `,A` have addresses of their own, in small letters: they are none of C, R and A.
inline char commaAddress(char letter) {
  return static_cast<char>(letter | 0x20);
}
inline bool isCommaAddress(char address) {
  return address >= 'a' && address <= 'z';
}
// "X", ",C"
std::string addressText(char address);

// As messages show it: "X[#1+2.]". It has a value.
std::string wordText(const nc::Word& word);

} // namespace dotek::frontend::macrob
