// How a run ended, in the words that a setter reads: the same in findings and in pictures.
#pragma once

#include "sim/machine/Machine.h"

#include <string>

namespace dotek::sim {

// "O9812, called by O1200 N30"; "" where neither a program nor a sequence number is known.
std::string callersText(const RunEnd& end);

// "alarm 3012"; where no source states the number, that.
std::string alarmName(const RunEnd& end);

// The active work coordinate system: "G54", "G54.1 P3".
std::string systemName(const Machine& machine);

} // namespace dotek::sim
