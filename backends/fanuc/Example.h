// Values for the call that the header shows.
#pragma once

#include "backends/fanuc/State.h"

namespace dotek::backends::fanuc {

// A value for each argument, in mm, degrees and mm/min: its default, else what such an argument usually has;
// where the checks reject these, others for those without a default that the checks let pass, if some are
// found.
std::map<ir::VariableId, double> exampleValues(const State& state);

} // namespace dotek::backends::fanuc
