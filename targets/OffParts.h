// Parts on which a limit of a call, or a comparison of the program's own, goes the other way: the translation
// has to stop, or go on, where the source does.
#pragma once

#include "targets/Verification.h"
#include "verify/Compare.h"

#include <functional>
#include <optional>
#include <vector>

namespace dotek::targets {

struct OffRules {
  // mm: farther beyond where a surface is expected no translation has to search; nothing: as far as the
  // source.
  std::optional<double> search;
  // Both sides count in eight digits and measure by the same macros, so that they compare what is measured
  // alike: the part is also such that a comparison is met exactly.
  bool exact = false;
  bool ties = false; // Verification::takesTies
};

// `compare`: the translation, run in that world, with a run of the source there. The first part on which both
// do not do the same, with what is particular about it in each text; empty: there is none.
std::vector<verify::Difference> compareOffParts(
    const TargetCase& now, const OffRules& rules,
    const std::function<std::vector<verify::Difference>(const verify::Record& source, sim::World& world)>&
        compare);

// The same into `out`, where each run of the translation has its differences by itself.
void addOffParts(const TargetCase& now, const OffRules& rules,
                 const std::function<TargetRun(const verify::Record& source, sim::World& world)>& run,
                 TargetRun& out);

} // namespace dotek::targets
