// What a program of a control writes in its own words, in those of the IR: places of the probe, work offsets,
// values that it keeps in variables.
#pragma once

#include "backends/cycle/State.h"

namespace dotek::backends::cycle {

// In the body, once, before variables get their names. What it does not know stays, and is refused where it
// is written.
void readIdioms(State& state);

// Variables that the source sets and reads again become names of the cycle's own, one for each value that is
// kept in them. Those that nobody reads stay: they are results.
void nameCommonVariables(State& state);

} // namespace dotek::backends::cycle
