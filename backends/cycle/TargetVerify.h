// Private to Target*.cpp.
#pragma once

#include "targets/Verification.h"

#include <memory>

namespace dotek::targets {

// The meaning of the written cycle beside its source.
std::unique_ptr<Verification> cycleVerification(const VerificationSource& source);

} // namespace dotek::targets
