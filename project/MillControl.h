// Cycles and programs are converted for machining centres.
#pragma once

#include "project/Session.h"
#include "stdlib/Control.h"

namespace dotek::project {

// The control is a lathe's: true, and reported.
bool refuseLathe(const stdlib::Control& control, Session& session);

} // namespace dotek::project
