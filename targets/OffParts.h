// Parts on which a limit of a call, or a comparison of the program's own, goes the other way: the translation
// has to stop, or go on, where the source does.
#pragma once

#include "targets/Verification.h"
#include "verify/Compare.h"

#include <functional>
#include <vector>

namespace dotek::targets {

// `run`: of the translation, in that world. `rules`: for a run of the source. The first part on which both do
// not do the same, with what is particular about it in each text; empty: there is none.
std::vector<verify::Difference>
compareOffParts(const TargetCase& now, const std::function<verify::Record(sim::World&)>& run,
                const std::function<verify::CompareRules(const verify::Record&)>& rules);

} // namespace dotek::targets
