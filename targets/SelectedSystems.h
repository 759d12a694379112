// What a posted program puts in force by itself before it moves there.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"
#include "verify/Draw.h"
#include "verify/Stand.h"

#include <cstdint>
#include <optional>
#include <set>

namespace dotek::targets {

// The first tool offset, and the work system before it moves in one.
struct Selected {
  std::optional<std::uint32_t> system, toolOffset;
};

// `switches`: macros that switch the probe and move nothing.
Selected selectedIn(const ir::Program& program, const stdlib::Control& control,
                    const std::set<std::uint32_t>& switches);

// What is drawn is meant in the additional work system that the program selects before it moves in one (G54.1
// Pn), and another one is in force at entry (`apart`), so that a selection that is missing shows.
void selectExtended(const ir::Program& program, const stdlib::Control& control,
                    const std::set<std::uint32_t>& switches, bool apart, verify::Entry& entry);

} // namespace dotek::targets
