// The words of one NC block as numbers: what a scanner of plain text, or a statement of a running macro
// program, hands to the machine. Plain arrays, filled anew for each block; nothing is allocated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dotek::ir {

// The bit of an address in the masks below; `letter` is A to Z.
constexpr std::uint32_t addressBit(char letter) {
  return std::uint32_t{1} << (letter - 'A');
}
constexpr std::uint32_t addressBits(const char* letters) {
  std::uint32_t out = 0;
  for (; *letters != '\0'; ++letters)
    out |= addressBit(*letters);
  return out;
}
// Codes, and numbers of tools, offsets, programs, blocks and repeats: whole on every control, with or without
// a point. E and F are neither these nor lengths.
inline constexpr std::uint32_t kWholeAddresses = addressBits("DGHLMNOPST");
// Whether `letter` is one of `addresses`; what is no capital letter never is.
constexpr bool isAddressIn(std::uint32_t addresses, char letter) {
  return letter >= 'A' && letter <= 'Z' && (addresses & addressBit(letter)) != 0;
}

// One block. G and M may appear in it several times and are kept in order; of every other address the order
// has no meaning. A null word (Macro B) is simply not present. Values are in the units of the text: the
// machine knows inches, degrees and the meaning of a missing point.
struct NcWords {
  static constexpr std::size_t kMostCodes = 16; // G words, and M words, of one block; a power of two

  enum Mark : std::uint8_t {
    None = 0,
    BlockDelete = 1,  // begins with `/`; `deleteLevel` says which
    ProgramMark = 2,  // `%`; nothing else is in the block
    ProgramName = 4,  // O and a number (then present as O), or <NAME>
    TooManyCodes = 8, // more than kMostCodes of G or of M
  };

  std::uint32_t present = 0;    // addressBit of each word
  std::uint32_t pointed = 0;    // those written with a decimal point; those of a computed value too
  std::uint32_t repeated = 0;   // those given twice, G and M aside
  std::uint32_t mostPlaces = 0; // most digits after the point that a word of the block has
  std::uint32_t gCount = 0;
  std::uint32_t mCount = 0;
  std::uint8_t marks = None;
  std::uint8_t deleteLevel = 0;              // of BlockDelete: 1 to 9
  std::array<std::uint32_t, kMostCodes> g{}; // code times ten: G54.1 is 541; kNoCode where the text is none
  std::array<std::uint32_t, kMostCodes> m{}; // code; kNoCode where the text is none
  std::array<double, 26> value{};            // by address; of G and M the last one
  std::uint64_t line = 0;                    // from 1, of the text; 0: no text

  static constexpr std::uint32_t kNoCode = 0xFFFFFFFF;

  bool has(char letter) const { return (present & addressBit(letter)) != 0; }
  double of(char letter) const { return value[static_cast<std::size_t>(letter - 'A')]; }
  void clear() {
    present = pointed = repeated = mostPlaces = gCount = mCount = 0;
    marks = None;
    deleteLevel = 0;
  }
  // For words that do not come from text: the value is computed, so it counts as written with a point.
  void set(char letter, double number) {
    const std::uint32_t bit = addressBit(letter);
    repeated |= present & bit;
    present |= bit;
    pointed |= bit;
    mostPlaces = 99; // the machine rounds it
    value[static_cast<std::size_t>(letter - 'A')] = number;
  }
  void addG(std::uint32_t tenths) { addCode('G', g, gCount, tenths); }
  void addM(std::uint32_t code) { addCode('M', m, mCount, code); }

private:
  void addCode(char letter, std::array<std::uint32_t, kMostCodes>& codes, std::uint32_t& count,
               std::uint32_t code) {
    present |= addressBit(letter);
    if (count == kMostCodes)
      marks |= TooManyCodes;
    else
      codes[count++] = code;
  }
};

} // namespace dotek::ir
