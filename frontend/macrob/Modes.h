// What is certain of the modal state before each block of a program, on every path that leads there.
#pragma once

#include "frontend/macrob/Ast.h"
#include "stdlib/Control.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace dotek::frontend::macrob {

// Unknown: a caller or a called program decides, or paths disagree.
enum class Certain : std::uint8_t { No, Yes, Unknown };

struct Modes {
  Certain feed = Certain::Unknown; // an F was given
  Certain cycle = Certain::Unknown;
  Certain levelR = Certain::Unknown, depth = Certain::Unknown,
          peck = Certain::Unknown; // of the cycle in force
  Certain compensation = Certain::Unknown;
  Certain rotation = Certain::Unknown;
  Certain returnsToR = Certain::Unknown;   // G99
  int cycleCode = 0;                       // 0: not known, as in what follows
  int plane = 0;                           // 17, 18, 19
  int distance = 0;                        // 90, 91
  int system = 0;                          // 54 to 59
  int motion = -1;                         // 0 to 3; -1: not known
  std::array<std::optional<double>, 3> at; // programmed X, Y, Z; nothing: not known
  // X, Y, Z that moved in turned coordinates, and not by an absolute move since.
  std::array<bool, 3> turned{};
  bool callsAfterMoves = false; // G66

  bool operator==(const Modes&) const = default;
};

// Two letters of the plane with the letters of the centre, the letter of its axis, and the centre's letter
// that belongs to no arc in it.
struct PlaneLetters {
  std::array<char, 2> axes, centre;
  char depth, unusedCentre;
};
// `plane`: 17 to 19.
const PlaneLetters& lettersOf(int plane);

// Ends with M30 or M2 and has a header: nothing before it has set a mode.
bool isMain(const Program& program);

// The modes that the block's own codes put in force, which hold for its words.
Modes within(const Words& words, Modes before);

// Before each block; nothing: no path leads there. Empty where the program is too long (20,000 blocks): such
// programs come from a CAM. `control` may be null.
std::vector<std::optional<Modes>> modesBefore(const Program& program, const stdlib::Control* control);

// Blocks that every path from the first block to the end of the program passes; all of them where no path
// ends.
std::vector<bool> passedByAllPaths(const Program& program);

} // namespace dotek::frontend::macrob
