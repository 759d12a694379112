// `dotek sim` of a program of Mikroprog.
#pragma once

#include "driver/Command.h"

namespace dotek::driver {

Outcome simMikroprog(const SimOptions& options, Session& session);

} // namespace dotek::driver
