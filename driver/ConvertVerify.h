// Private to Convert*.cpp: `--verify`.
#pragma once

#include "driver/Driver.h"

namespace dotek::driver {

// Runs each input beside its result of `outcome`, which convert gave with status 0. What differs, or is not
// the same in enough cases, takes all results away; the findings are among the diagnostics.
Outcome verified(const ConvertOptions& options, Outcome outcome);

} // namespace dotek::driver
