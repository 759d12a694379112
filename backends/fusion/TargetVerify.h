// Private to Target*.cpp.
#pragma once

#include "targets/Verification.h"

namespace dotek::targets {

// A fragment for Fusion, run on the kernel's double; its text runs like the posted one.
std::unique_ptr<Verification> fusionVerification(const VerificationSource& source);

} // namespace dotek::targets
