// Private to Convert*.cpp and Lowering.cpp: values of parameters against the cycle's own checks.
#pragma once

#include "project/Lowering.h"

#include <set>

namespace dotek::project {

// Where the fixed values leave no way through the checks, whatever the rest is: an alarm that they end in.
std::optional<ir::Statement> certainAlarm(const LoweredCycle& lowered);
void reportRejected(const CycleFolder& folder, const ir::Statement& alarm, Session& session);

// Takes `--default NAME=VALUE`; `used` collects the names that the cycle knows. Errors are reported.
void applyDefaults(const NamedTexts& given, LoweredCycle& lowered, std::set<std::string>& used,
                   Session& session);

// Reports defaults of `--default` that the checks turn away. A default of the source that they turn away is a
// warning, and is taken away: the argument becomes mandatory.
void settleValues(const CycleFolder& folder, LoweredCycle& lowered, Session& session);

} // namespace dotek::project
