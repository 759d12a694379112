// Private to Target*.cpp: what the control of the translation reads while it still moves.
#pragma once

#include "backends/common/EmittedLine.h"
#include "project/Session.h"
#include "stdlib/Control.h"

#include <vector>

namespace dotek::targets {

// Warns at the places of the source where the control reads on past a skip that the source's control may have
// waited for, and the result of the skip follows.
void warnOfEarlyReads(const std::vector<backends::EmittedLine>& lines, const stdlib::Control& control,
                      project::Session& session);

} // namespace dotek::targets
