// `dotek sim` of a program of Mikroprog.
#pragma once

#include "driver/Session.h"

namespace dotek::driver {

Outcome simMikroprog(const SimOptions& options, Session& session);

} // namespace dotek::driver
