// The fields of a cycle as the cases of `verify` draw them.
#pragma once

#include "project/CycleFolder.h"
#include "project/Lowering.h"
#include "targets/Subject.h"

namespace dotek::targets {

// Fields and what is known of them into the plan: kinds, first values, how many digits are printed, what the
// dialog offers, where the checks turn.
void takeFields(const LoweredCycle& lowered, const CycleFolder& folder, const LoweringInputs& inputs,
                VerifyPlan& plan);
// Nothing that is measured comes to it. It is a threshold of each field that only limits what is measured, so
// that values are drawn with which the comparison passes.
inline constexpr double kBeyondMeasured = 487.25; // mm; no check is written with it
// The same of a cycle whose branch cannot be translated: names and first values alone.
void takeDeclaredFields(const CycleFolder& folder, const LoweringInputs& inputs, VerifyPlan& plan);

} // namespace dotek::targets
