// `sim` with a device beside the control.
#pragma once

#include "driver/Driver.h"
#include "sim/run/DeviceOptions.h"

namespace dotek::driver {

// As sim(options); the files of the report come after the pictures.
Outcome sim(const SimOptions& options, const sim::DeviceOptions& device);

} // namespace dotek::driver
