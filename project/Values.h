// Values of parameters against the cycle's own checks.
#pragma once

#include "project/Lowering.h"

#include <set>

namespace dotek::project {

// Where the fixed values leave no path through the checks, whatever the rest is: an alarm that they end in.
std::optional<ir::CycleStatement> certainAlarm(const LoweredCycle& lowered);
// With the values that are to blame, where single ones are.
void reportRejected(const CycleFolder& folder, const LoweredCycle& lowered, const ir::CycleStatement& alarm,
                    Session& session);

// Takes `--default NAME=VALUE`; `used` collects the names that the cycle knows. Errors are reported.
void applyDefaults(const NamedTexts& given, LoweredCycle& lowered, std::set<std::string>& used,
                   Session& session);

// Reports defaults of `--default` that the checks reject. A default of the source that they reject is a
// warning, and is taken away: the argument becomes mandatory.
void settleValues(const CycleFolder& folder, LoweredCycle& lowered, Session& session);

// ---- one operation, for programs without arguments
// The operation of the job for this folder; nullptr: none, or several, which is reported.
const JobOperation* operationOf(const CycleFolder& folder, const LoweringInputs& inputs, Session& session);
// Its start point, host inputs and values, as far as no flag gives them.
void takeOperation(const JobOperation& operation, const CommonOptions& options, LoweringInputs& inputs);

} // namespace dotek::project
