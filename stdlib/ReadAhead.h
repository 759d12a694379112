// How far a control reads ahead of its motion: which codes wait for it, as its profile says.
#pragma once

#include "stdlib/Control.h"

#include <optional>
#include <string>

namespace dotek::stdlib {

// The code waits until the motion before it is done. G103 is none of them: see readAheadLimit().
bool stopsReadingAhead(const Control& control, char letter, double code);

// What a block with G103 and this P says from there on: true, that the control reads one block ahead at most,
// false, that it reads on. Nothing: the profile does not list G103. No P reads on.
std::optional<bool> readAheadLimit(const Control& control, std::optional<double> p);

// What to put between a motion and a block that needs its end: "`G53` or `G4 P0`".
std::string waitAdvice(const Control& control);

} // namespace dotek::stdlib
