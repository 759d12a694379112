// What a caller has in the tables of the control when a cycle of the cycle language is called.
#pragma once

#include "targets/Verification.h"
#include "verify/Stand.h"

namespace dotek::targets {

// Tools whose offsets the case names have what toolEntries() says.
void presetTools(const VerificationSource& from, const verify::Case& drawn, verify::Entry& entry);

} // namespace dotek::targets
