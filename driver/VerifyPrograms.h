// Private to Verify*.cpp: programs of macro B against their conversion.
#pragma once

#include "driver/Command.h"

namespace dotek::driver {

Outcome verifyPrograms(const VerifyOptions& options, Session& session);

} // namespace dotek::driver
