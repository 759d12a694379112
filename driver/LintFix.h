// Makes the safe repairs of findings.
#pragma once

#include "driver/Driver.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dotek::driver {

// One repair, as a note says it: where it was made, and what is there now.
struct MadeFix {
  std::string file; // as named on the command line
  std::uint32_t line = 0, column = 0;
  std::string code;
  std::string before, after; // text that was replaced, on one line
};

// The texts of files with the safe repairs of `outcome` made, by the names of the command line; a byte order
// mark is left away. `made`: each repair. What overlaps waits for another turn.
std::vector<OutputFile> safeFixes(const Outcome& outcome, std::vector<MadeFix>& made);

// Writes the files with the safe repairs of `outcome` made: all or none. Nothing is written where there is
// none. What overlaps waits for another turn. `force`: files that are write-protected, too.
std::vector<MadeFix> applySafeFixes(const Outcome& outcome, const Limits& limits, bool force,
                                    Diagnostics& diagnostics);

// One note a repair; of many of one rule in a file their number. Places are those of `outcome`, which was
// read after them.
void reportFixes(const std::vector<MadeFix>& made, Outcome& outcome);

// What lint with `fix` would write, as `files`; nothing is written. `sources` holds the texts as they are,
// the summary says how much is repaired. The status is 1 where a repair is proposed, else 0.
Outcome proposeFixes(const LintOptions& options);

} // namespace dotek::driver
