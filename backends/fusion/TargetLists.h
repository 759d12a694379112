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

// By name of the field or parameter, in one case.
using ChoiceLists = std::map<std::string, std::vector<DialogChoice>>;

// Those of the parameters of a cycle file; what it says has been said.
ChoiceLists listsOfCycle(const std::string& file, const project::CommonOptions& options);
// The lists of the fragment say of each value what the source says of it.
void compareLists(const ChoiceLists& lists, const backends::fusion::RunResult& result,
                  const std::string& prefix, TargetRun& out);

} // namespace dotek::targets
