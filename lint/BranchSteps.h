// What the branches of a Prog make the machine do, block by block: the view of rules about how a branch
// begins and ends.
#pragma once

#include "lint/ProgBlocks.h"

namespace dotek::lint {

// What one printed block does. Of a block below an IF it may do so.
struct BlockDeeds {
  bool measures = false;        // a measuring call, or G31
  bool outside = false;         // its measurement goes down and comes up again by itself: a web, a boss
  bool movesZ = false;          // a move with Z, plain or protected, or a return home; no measurement
  bool stopsSpindle = false;    // M5, an orientation, a tool change
  bool stopsCoolant = false;    // M9
  bool switchesProbeOn = false; // by a macro
  // G90 and G91 of the block, the last one counts.
  bool absolute = false, incremental = false;
};
BlockDeeds deedsOf(const ProgBlock& block, const Project& project);

// One branch for one cycle, with what the Prog prints around it for this cycle, as far as the Prog shows it:
// before and after the IF in its routine, and in routines that call this one.
struct BranchSteps {
  const compost::Program* prog = nullptr;
  std::string id;
  SourceRange branch; // its IF
  struct Step {
    BlockDeeds deeds;
    SourceRange range;
    bool conditional = false;
  };
  std::vector<Step> steps; // of the branch
  std::vector<BlockDeeds> before, after;
};
std::vector<BranchSteps> branchSteps(const Project& project);

} // namespace dotek::lint
