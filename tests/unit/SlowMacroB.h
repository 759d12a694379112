// The second way to run Macro B: walks the syntax tree of a file, as slow and direct as it goes. Written from
// the tables of the language alone; the compiled machine is compared with it on made-up programs. What the
// tables leave open ends a run as `Unsupported`.
#pragma once

#include "tests/unit/SlowValues.h"

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dotek::tests {

// The machine and its switches.
struct MacroSetup {
  std::string control = "fanuc-31i-b"; // whose programs they are
  bool decimal8 = false;               // 8 decimal digits instead of doubles
  bool calculator = true;              // X10 is 10 mm; false: 0.010 mm
  std::set<int> switches;              // of block delete that are on, 1 to 9
  int macroLevels = 5;                 // of G65 and G66
  int callLevels = 15;                 // M98 included
  int sequenceLast = 9999;             // greatest target of GOTO
  std::vector<std::pair<int, int>> common = {{100, 199}, {500, 999}};
  std::uint64_t budget = 20000; // blocks, then the run ends
};

using MacroPosition = std::array<double, 3>; // X Y Z, mm

struct MacroOutcome {
  SlowStop::Kind ending = SlowStop::Kind::Unsupported;
  int alarm = 0;                        // of Alarm
  std::string reason;                   // of Unsupported
  std::uint32_t line = 0;               // of the block that ended the run, from 1
  std::uint64_t sequence = 0;           // its N number, 0: none
  std::map<int, double> common;         // those that are not null
  std::map<int, double> locals;         // of the main program at the end, those that are not null
  std::string output;                   // of DPRNT, one line each
  std::vector<MacroPosition> positions; // end of each block that names an axis
  // A decision was taken where the last bit of a function counts: nothing to compare.
  bool fragile = false;
  std::uint64_t blocks = 0; // read
};

// Runs the first program of a file.
MacroOutcome runSlowly(const std::string& text, const MacroSetup& setup = {});

// All of it in lines, for messages.
std::string describe(const MacroOutcome& outcome);
// What differs first, "": nothing. Numbers may differ by 1e-12 of their size; positions that repeat count
// once.
std::string difference(const MacroOutcome& slow, const MacroOutcome& other);

} // namespace dotek::tests
