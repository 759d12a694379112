// Private to Dialects.cpp: the languages that are no input of Dotek, and what gives each away. One table:
// a dialect or a mark is added there and nowhere else.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace dotek::project {

enum class Tongue : std::uint8_t {
  Sinumerik,
  Heidenhain,
  HeidenhainIso,
  Okuma,
  LinuxCnc,
  Grbl,
  RepRap,
  Printer,
  Klipper,
  Fagor,
  Fadal,
  Eding,
  WireEdm,
  Parameters,
  Script,
  Markdown,
};
inline constexpr std::size_t kTongues = 16;

struct TongueFacts {
  Tongue tongue;
  std::string_view name;   // "Sinumerik (Siemens)"
  int least;               // the weight of its marks that makes a text one of it
  bool control;            // a language of machines: its lines are named; else it is just no program
  std::string_view remedy; // what corresponds in Macro B, for the message; "" where nothing does
};
const TongueFacts& factsOf(Tongue tongue);

// Where a mark has to be.
enum class Place : std::uint8_t {
  Begin, // of the line, or after its block number
  Word,  // anywhere outside of comments in round brackets, not within a word
  Raw,   // anywhere in the line, comments too
  Shape, // `fits` says
};

struct Mark {
  Tongue tongue;
  Place place;
  std::string_view text; // in capitals; of a Shape what a message shows
  int weight;            // 5: no input of Dotek has it; 4: no block of Macro B is or begins so
  // `body`: a line in capitals without its block number and without comments in round brackets.
  bool (*fits)(std::string_view body) = nullptr;
};
std::span<const Mark> dialectMarks();

// Helpers of shapes, for Dialects.cpp.
std::string_view trimmedText(std::string_view text);
// After `N10`, or the bare number of a Heidenhain block.
std::string_view withoutBlockNumber(std::string_view text);

} // namespace dotek::project
