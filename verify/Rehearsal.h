// The part that a program expects, by what it measured in a rehearsal (Recorder::rehearse).
#pragma once

#include "verify/DrawnPath.h"
#include "verify/Random.h"
#include "verify/Record.h"

#include <vector>

namespace dotek::verify {

// Surfaces by the calls' arguments; of a bare skip move the one that it meets at its end.
std::vector<Touch> touchesOf(const Record& rehearsal, double ballRadius);

// Where the part is: off by at most 0.3 mm, a third of the ball's radius and of the shortest path of a
// bare skip move, towards those moves that do not go on beyond the surface. Turned by at most 0.3 degrees
// where no bare skip move is made.
PartError drawError(const Record& rehearsal, double ballRadius, Random& random);

} // namespace dotek::verify
