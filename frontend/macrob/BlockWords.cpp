#include "frontend/macrob/BlockWords.h"

#include "frontend/macrob/Format.h"

namespace dotek::frontend::macrob {

const nc::Word* findWord(const Words& words, char letter) {
  for (const nc::Word& word : words.words)
    if (word.address == letter && word.value != nullptr) return &word;
  return nullptr;
}

const nc::Word* findAnyOf(const Words& words, std::string_view letters) {
  for (const nc::Word& word : words.words)
    if (letters.find(word.address) != std::string_view::npos) return &word;
  return nullptr;
}

std::string addressText(char address) {
  return isCommaAddress(address) ? std::string{',', static_cast<char>(address & ~0x20)}
                                 : std::string(1, address);
}

std::string wordText(const nc::Word& word) {
  return addressText(word.address) + print(*word.value);
}

} // namespace dotek::frontend::macrob
