// What cycles consist of, for targets that have no call for them: the one place that says it.
#pragma once

#include "ir/Statement.h"

#include <vector>

namespace dotek::backends {

// The measurements that together do what the cycle does, in their order, each from the place where the probe
// is when the cycle begins. Empty: the cycle is more than that, or an argument has no place in them.
std::vector<ir::Measure> touchesOf(const ir::CallCycle& cycle);

} // namespace dotek::backends
