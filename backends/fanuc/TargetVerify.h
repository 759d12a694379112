// Private to Target*.cpp.
#pragma once

#include "targets/Verification.h"

#include <memory>

namespace dotek::targets {

// A program that is called with its arguments.
std::unique_ptr<Verification> fanucVerification(const VerificationSource& source);

} // namespace dotek::targets
