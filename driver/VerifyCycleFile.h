// verify of a file of the cycle language.
#pragma once

#include "driver/Command.h"

namespace dotek::driver {

Outcome verifyCycleFile(const VerifyOptions& options, Session& session);

} // namespace dotek::driver
