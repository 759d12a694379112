// Touches of the source that one call of the target makes.
#pragma once

#include "verify/Record.h"

#include <optional>

namespace dotek::verify {

// The source with the touches of each feature that the target measures by one call as one measure: as many as
// the call has surfaces, with the moves between them, from where the call begins to where it ends. A source
// that stops in an alarm on the way has the surfaces that it did not come to by the call's arguments.
// `tolerance`: of places, mm. nullopt: there is nothing to join.
std::optional<Record> joinedTouches(const Record& source, const Record& target, double tolerance);

} // namespace dotek::verify
