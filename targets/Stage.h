// The stage on which both sides of a case run.
#pragma once

#include "stdlib/Control.h"
#include "targets/Subject.h"

namespace dotek::targets {

// A calibrated probe with the ball of the case, as exact as its signal; off.
sim::Probe probeFor(const VerifyPlan& plan, const verify::Case& drawn);
verify::Entry entryFor(const VerifyPlan& plan, const verify::Case& drawn, bool probeOn);
// Nothing that a probe could meet.
sim::Part emptyPart(const sim::Point3& middle);
// What results may differ by where one of the controls computes with eight digits, mm.
double resultTolerance(const stdlib::Control& one, const stdlib::Control& other);

} // namespace dotek::targets
