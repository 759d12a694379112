// What the user reads of a fragment's properties: their titles, what their lists offer.
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

// No property has the title of another field in the place of its own: its value would be given for that one.
// Other titles are the user's.
void compareTitles(const std::vector<verify::DrawField>& fields, const project::CycleFolder& folder,
                   const SourceMap& sources, const backends::fusion::RunResult& result,
                   const std::string& prefix, TargetRun& out);

} // namespace dotek::targets
