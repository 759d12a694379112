// Makes the safe repairs of findings.
#pragma once

#include "driver/Driver.h"

#include <cstdint>
#include <map>
#include <string>

namespace dotek::driver {

// Writes the files with the safe repairs of `outcome` made: all or none. Gives the number of repairs by file,
// as named on the command line; nothing is written where there is none. What overlaps waits for another turn.
// `force`: files that are write-protected, too.
std::map<std::string, std::uint32_t> applySafeFixes(const Outcome& outcome, const Limits& limits, bool force,
                                                    Diagnostics& diagnostics);

} // namespace dotek::driver
