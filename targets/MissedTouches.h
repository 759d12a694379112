// Touches of bare skip moves that find nothing, or something just where the source goes another way: the
// guards of the source after each are those of the translation.
#pragma once

#include "targets/Verification.h"
#include "verify/Compare.h"
#include "verify/Interference.h"

#include <functional>
#include <vector>

namespace dotek::targets {

// `run`: of the translation, disturbed like this. `rules`: for a run of the source; their places are those of
// the case. `exact`: both sides count in eight digits, so that they compare what is measured alike. The first
// touch after which both do not do the same, with its number from 1 in each text; empty: there is none, or
// the two do not touch equally often.
std::vector<verify::Difference>
compareMissed(const TargetCase& now, const verify::Record& ran,
              const std::function<verify::Record(const verify::Interference&)>& run,
              const std::function<verify::CompareRules(const verify::Record&)>& rules, bool exact);

} // namespace dotek::targets
