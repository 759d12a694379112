// Private to Convert*.cpp: values of parameters against the cycle's own checks.
#pragma once

#include "driver/Lowering.h"

#include <set>

namespace dotek::driver {

// Takes `--default NAME=VALUE`; `used` collects the names that the cycle knows. Errors are reported.
void applyDefaults(const NamedTexts& given, LoweredCycle& lowered, std::set<std::string>& used,
                   Session& session);

// Reports fixed values, and defaults of `--default`, that the checks turn away whatever the rest is. A
// default of the source that they turn away is a warning, and is taken away: the argument becomes mandatory.
void settleValues(const CycleFolder& folder, LoweredCycle& lowered, Session& session);

} // namespace dotek::driver
