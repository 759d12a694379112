// verify --to fusion of files of the cycle language: cases of the fragment and of the program that it
// carries.
#pragma once

#include "targets/Verification.h"

#include <memory>

namespace dotek::targets {

std::unique_ptr<Verification> fusionCycleVerification(const VerificationSource& source);

} // namespace dotek::targets
