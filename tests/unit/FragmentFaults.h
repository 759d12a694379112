// Faults in a part of a Fusion post: what it owes the post, what it prints, what it checks (docs/fusion.md).
#pragma once

#include "tests/unit/FaultOperators.h"

#include <string_view>
#include <vector>

namespace dotek::tests {

const std::vector<std::string_view>& fragmentFaultKinds();
// All places of the fragment where the operator fits; its private functions are left alone.
std::vector<Fault> fragmentFaultsOf(std::string_view kind, std::string_view fragment);

} // namespace dotek::tests
