// Private to Target*.cpp: which fields a cycle has in the CAM.
#pragma once

#include "backends/gibbs/Emit.h"
#include "ir/Fold.h"
#include "project/CycleFolder.h"
#include "project/Lowering.h"
#include "project/Session.h"

#include <set>
#include <string>

namespace dotek::targets {

using namespace project; // NOLINT(google-build-using-namespace)

// Parameters that may be left out and have no default are: a field always holds a number. Warned of.
std::set<ir::VariableId> leaveOut(LoweredCycle& lowered, Diagnostics& diagnostics);

// After folding: a parameter that was left out and that the checks give a value by its rule is not left out
// first.
void dropAbsences(LoweredCycle& lowered);

// Fixes parameters of a folded cycle that nothing but their own range depends on at their defaults, with a
// note, and folds again. `keepChecked`: what a check looks at stays.
void fixUnused(LoweredCycle& lowered, bool keepChecked, const ir::FoldOptions& folding,
               Diagnostics& diagnostics);

// Fields with their first values, and checks of those that hold a work offset. `file`: of the cycle language;
// nullptr: the cycle is a folder. `sameMacros`: the branch calls those of the source. What has no first value
// is reported.
backends::gibbs::Folder folderOf(const CycleFolder& folder, LoweredCycle& lowered,
                                 const std::set<ir::VariableId>& without, backends::gibbs::Names& names,
                                 const std::string* file, bool sameMacros, Session& session);

// Reports host inputs that neither a field nor the post has.
void checkHosts(const ir::Cycle& cycle, Diagnostics& diagnostics);

} // namespace dotek::targets
