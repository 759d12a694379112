// What the lists of a fragment's properties offer.
#pragma once

#include "backends/fusion/Run.h"
#include "project/Session.h"
#include "targets/DialogChoices.h"
#include "targets/Verification.h"

#include <map>
#include <string>
#include <vector>

namespace dotek::targets {

// The lists of the fragment say of each value what the source says of it.
void compareLists(const ChoiceLists& lists, const backends::fusion::RunResult& result,
                  const std::string& prefix, TargetRun& out);

} // namespace dotek::targets
