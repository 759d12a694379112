// The number of a word, eight bytes at a time. Private to the scanner.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace dotek::frontend::nc {

enum class NumberFault : std::uint8_t {
  None,
  Missing,
  TooLong, // two points, or more digits than any control has
};

struct ScannedNumber {
  const char* behind = nullptr; // nullptr: none, see `fault`
  std::uint64_t digits = 0;     // without the point, where there are at most 18
  double value = 0;             // equals strtod of the text
  std::uint32_t places = 0;     // digits after the point
  bool point = false;
  bool minus = false;
  NumberFault fault = NumberFault::None;
};

// Powers of ten that a double holds exactly: a quotient of two exact numbers is rounded once.
inline constexpr std::array<double, 23> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                        1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                        1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Numbers of any form, with blanks before and after the sign.
ScannedNumber scanLongNumber(const char* p);

// A number of one to eight bytes that follows its address and fills all the room to the next word.
struct ShortNumber {
  std::uint64_t digits = 0;
  std::uint64_t minus = 0;  // 1 or 0
  std::uint64_t point = 0;  // 1 or 0
  std::uint64_t places = 0; // digits after the point
  std::uint64_t odd = 0;    // not 0: no such number, and the rest has no meaning
  double value = 0;
};

// [p, p + length) is the number; 9 bytes can be read from `p`. Signs, points and lengths follow no pattern
// that a processor could foresee, so there is no branch. Takes a machine that stores the lowest byte first.
inline ShortNumber readShortNumber(const char* p, std::size_t length) {
  constexpr std::uint64_t kOnes = 0x0101010101010101, kHigh = 0x8080808080808080;
  ShortNumber out;
  out.minus = *p == '-' ? 1 : 0;
  const std::uint64_t count = length - out.minus;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, p + out.minus, 8);
  // A digit becomes its value. The number moves to the top: the bytes below are leading zeros.
  const std::uint64_t d = (bytes ^ kOnes * '0') << ((64 - count * 8) & 63);
  const std::uint64_t noDigits = ((d + kOnes * 0x76) | d) & kHigh;
  // The lowest byte that is a point, certainly; above it a second one counts as odd, true or not.
  const std::uint64_t x = d ^ kOnes * ('.' ^ '0');
  const std::uint64_t points = (x - kOnes) & ~x & kHigh;
  const std::uint64_t none = points == 0 ? 1 : 0;
  out.point = none ^ 1;
  // 1 to 8 bytes, nothing but digits and one point, a digit beside it.
  out.odd = (noDigits ^ points) | (points & (points - 1)) |
            (((count - 1) | (count - 1 - out.point)) & ~std::uint64_t{7});
  out.places = static_cast<std::uint64_t>(__builtin_clzll(points | none << 63)) / 8; // never of 0
  // What precedes the point moves up into its place.
  const std::uint64_t front = d & ((points >> 7) - 1);
  const std::uint64_t back = d & ~((points << 1) - 1);
  std::uint64_t digits = (front << (out.point * 8)) | back;
  digits = (digits * 10 + (digits >> 8)) & 0x00FF00FF00FF00FF;
  digits = (digits * 100 + (digits >> 16)) & 0x0000FFFF0000FFFF;
  digits = (digits * 10000 + (digits >> 32)) & 0xFFFFFFFF;
  out.digits = digits;
  const double value = static_cast<double>(static_cast<std::int64_t>(digits)) / kPowersOfTen[out.places];
  out.value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) | out.minus << 63);
  return out;
}

// Whether a word of the macro language begins with these two letters: GOTO, IF, WHILE, DO, END, THEN, POPEN,
// PCLOS, DPRNT, BPRNT, SETVN. Two letters that are none of them are an address without its number.
inline bool beginsMacroWord(char first, char second) {
  constexpr char kBegins[][3] = {"GO", "IF", "WH", "DO", "EN", "TH", "PO", "PC", "DP", "BP", "SE"};
  for (const char* const begin : kBegins)
    if ((first & 0x5F) == begin[0] && (second & 0x5F) == begin[1]) return true;
  return false;
}

} // namespace dotek::frontend::nc
