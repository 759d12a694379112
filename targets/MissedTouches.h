// A probe that meets something else than the part: touches that find nothing, or something just where the
// source goes another way, and what is in the path of protected moves. The guards of the source after each
// are those of the translation.
#pragma once

#include "targets/Verification.h"
#include "verify/Compare.h"
#include "verify/Interference.h"

#include <functional>
#include <optional>
#include <vector>

namespace dotek::targets {

struct DisturbedSides {
  // Nothing: what the source does is not known.
  std::function<std::optional<verify::Record>(const verify::Interference&)> source;
  std::function<verify::Record(const verify::Interference&)> target;
  // For a run of the source; their places are those of the case.
  std::function<verify::CompareRules(const verify::Record&)> rules;
};

// Each bare search and each measuring call finds nothing, once after the other; each protected move meets
// something half way, and before its end just where the source turns. `source`, `ran`: undisturbed. The first
// after which both do not do the same, with what is particular about it in each text; empty: there is none.
// What the two do not do equally often is passed over.
std::vector<verify::Difference> compareDisturbed(const verify::Record& source, const verify::Record& ran,
                                                 const DisturbedSides& sides);

// The same of a case of a cycle. `exact`: both sides count in eight digits, so that they compare what is
// measured alike: each bare search also ends just where the source goes another way.
std::vector<verify::Difference>
compareMissed(const TargetCase& now, const verify::Record& ran,
              const std::function<verify::Record(const verify::Interference&)>& run,
              const std::function<verify::CompareRules(const verify::Record&)>& rules, bool exact);

} // namespace dotek::targets
