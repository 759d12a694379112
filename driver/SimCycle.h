// `dotek sim NAME.cycle`.
#pragma once

#include "driver/Command.h"
#include "driver/Driver.h"

namespace dotek::driver {

Outcome simCycle(const SimOptions& options, project::Session& session);

} // namespace dotek::driver
