// How exactly two runs can agree.
#pragma once

#include "verify/Compare.h"

namespace dotek::verify {

// What another macro set computes from other contacts, each on the grid of a nanometre: two steps, and what a
// subtraction leaves; mm.
inline constexpr double kGridSteps = 2.5e-6;

// `rules` as exact as this run of the source lets them be (CompareRules::results, mm).
CompareRules asExactAs(const Record& source, CompareRules rules);

} // namespace dotek::verify
