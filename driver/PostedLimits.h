// Limits of probing macros in the blocks of a post.
#pragma once

#include "frontend/compost/Post.h"
#include "project/Session.h"

#include <vector>

namespace dotek::driver {

// Reports each posted call of a known probing macro whose tolerance, upper limit or null band is below 0. A
// call that a macro set refuses, and what is no call, are passed over.
void reportLimits(const std::vector<frontend::compost::PostedLine>& lines, project::Session& session);

} // namespace dotek::driver
