// One call of the source that several of the target make.
#pragma once

#include "verify/Record.h"

#include <optional>

namespace dotek::verify {

// The target with calls as one that follow each other from one place, each back to it, with the same letters
// beside, as far as one measure of the source has as many surfaces. `tolerance`: of places, mm. nullopt:
// there is nothing to join.
std::optional<Record> joinedCalls(const Record& source, const Record& target, double tolerance);

} // namespace dotek::verify
