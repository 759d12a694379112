// How exactly two runs can agree.
#pragma once

#include "verify/Compare.h"

namespace dotek::verify {

// `rules` as exact as this run of the source lets them be (CompareRules::results, mm).
CompareRules asExactAs(const Record& source, CompareRules rules);

} // namespace dotek::verify
