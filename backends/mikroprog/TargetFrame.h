// Private to Target*.cpp: what a program for Mikroprog does around its measures. The rules are in
// docs/verify.md.
#pragma once

#include "ir/Program.h"
#include "stdlib/MikroprogControl.h"
#include "verify/Compare.h"

#include <optional>
#include <string>
#include <vector>

namespace dotek::targets {

// How a run ends after a stop that stands for an alarm: what it does after it, without the stop.
struct MikroprogTail {
  double height = 0;                // Z of the machine
  double z = 0;                     // the same in the active system
  std::vector<verify::Piece> moves; // straight up
};

// Where and how the tails go up.
struct MikroprogRetract {
  double least = 0; // Z of the machine
  double z = 0;     // in the active system, to `tolerance`
  double tolerance = 0;
  double feed = 0; // mm/min
};

// The stop in which a run ends, as the alarm that it stands for, without what comes after it. nullopt: the
// run does not end so.
std::optional<MikroprogTail> takeEnding(verify::Record& ran, const stdlib::MikroprogControl& control);

// By how much Z counts more than in the source after one of its datums, at most; mm. `zero`: of the active
// system.
double mostRaised(const verify::Record& source, const sim::Point3& zero, double ballRadius);

// What is wrong with a tail; "": nothing.
std::string tailFault(const MikroprogTail& tail, const MikroprogRetract& wanted);

// What the text shows: the modes of the beginning, the tail of each G31.
std::optional<verify::Difference> textFault(const ir::Program& program,
                                            const stdlib::MikroprogControl& control);

// What the run shows: contact is asked for, spindle and coolant are off. `height`: the program knows at which
// Z it begins, so that this holds before anything moves.
std::vector<verify::Difference> frameFaults(const verify::Record& source, const verify::Record& ran,
                                            bool height);

// The program goes to its start point first: `beside` is the same run, begun `by` beside it.
std::optional<verify::Difference> startFault(const verify::Record& ran, const verify::Record& beside,
                                             const sim::Point3& by);

} // namespace dotek::targets
