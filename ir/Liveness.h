// Which variables are read before they are assigned.
#pragma once

#include "ir/Statement.h"

#include <set>
#include <vector>

namespace dotek::ir {

// Variables whose value at the beginning of the list some path reads. `after`: those that are read after its
// end.
std::set<VariableId> liveAtEntry(const std::vector<CycleStatement>& list, const std::set<VariableId>& after);

} // namespace dotek::ir
