// How a run went, told from how it ended and from what happened on its path.
#pragma once

#include "sim/machine/Machine.h"
#include "sim/machine/World.h"
#include "sim/picture/Picture.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::sim {

// What makes a run wrong, or doubtful, though it came to its end and nothing crashed.
struct RunFault {
  Verdict verdict = Verdict::Fail;
  std::string word, text; // of the banner
};

struct RunFacts {
  RunEnd end;                             // still running: the program could not be read to its end
  std::string callers;                    // as of callersText()
  std::string unread;                     // of a program that could not be read: why
  PictureBlock block;                     // at which the run ended
  std::array<std::uint64_t, 16> events{}; // by Outcome; misses that were meant are none
  std::string_view subject = "program";   // what ran
  std::uint64_t usedMisses = 0;           // misses whose end was taken for the surface
  std::vector<RunFault> faults = {};      // in the order of the run
  std::size_t warnings = 0;               // that the run has reported
};

// The banner of a picture whose moves, errors and frames are complete. A collision comes before the alarm
// that follows from it: place and position are those of the first.
PictureResult resultOf(const Picture& picture, const RunFacts& facts);

// What stopped the run, one line: an error of the picture. "": the program came to its end.
std::string endingText(const RunFacts& facts);
// The run ended with the alarm of an over-travel, which is an error of the picture already.
bool isSaidByTravel(const RunFacts& facts);

// "X1.000 Y-2.500 Z0.000"; "?" for what is no number.
std::string pointText(const Point3& p, int decimals);

} // namespace dotek::sim
