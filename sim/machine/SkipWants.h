// What a program wants of its skip moves, from the way that leads to its alarm.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"

#include <cstddef>
#include <set>

namespace dotek::sim {

// Those of `skips` (indices of statements) that want a contact: a condition on where the move ended leads to
// an alarm (#3000) with a move that came to its end, and to none before it; or the next skip move goes the
// same way along the one axis of this one after nothing but moves back along it. The end is put into the
// condition; where that does not decide it, the move is not in the result.
std::set<std::size_t> wantingContact(const ir::Program& program, const std::set<std::size_t>& skips,
                                     const stdlib::Control& control);

} // namespace dotek::sim
