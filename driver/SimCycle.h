// `dotek sim NAME.cycle`.
#pragma once

#include "driver/Driver.h"
#include "project/Session.h"

namespace dotek::driver {

Outcome simCycle(const SimOptions& options, project::Session& session);

} // namespace dotek::driver
