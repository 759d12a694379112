// What a program does with where a G31 has stopped, up to the next G31.
#pragma once

#include "lint/NcProgram.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dotek::lint {

// Statements that may run after the G31 with this index and before another G31, each once, in the order of
// the text. nullopt: more than a few hundred, or a computed jump.
std::optional<std::vector<std::size_t>> afterSkip(const NcProgram& nc, std::size_t skip);

// #5001 to #5003, #5021 to #5023, #5041 to #5043 and #5061 to #5063: the axis of a position.
std::optional<AxisSet> positionAxis(std::uint32_t variable);

// The variable that this statement sets is read by conditions alone until it is set again: what a program
// asks of a watched move by `#651=#5063-#5083` and `IF[#651 GT 2.]GOTO 800`.
bool askedAlone(const NcProgram& nc, std::size_t store);

// A condition that looks at a position or another variable of the control, M78 or M79 (an alarm of some
// controls by the skip signal), a call, which may look at all of them.
bool mayAskControl(const ir::ProgramStatement& statement);

// The values of both blocks for this address are the same expression, or both have none.
bool sameWord(const ir::NcBlock& a, const ir::NcBlock& b, char address);
// They have the same axes with the same values.
bool sameTarget(const ir::NcBlock& a, const ir::NcBlock& b);

} // namespace dotek::lint
