// Faults in what surrounds the motion of a called program of Macro B: what it asks of its caller, keeps, puts
// back and waits for (docs/convert.md).
#pragma once

#include "tests/unit/FaultOperators.h"

#include <string_view>
#include <vector>

namespace dotek::tests {

const std::vector<std::string_view>& frameFaultKinds();
// All places of `program` where the operator fits.
std::vector<Fault> frameFaultsOf(std::string_view kind, std::string_view program);

} // namespace dotek::tests
