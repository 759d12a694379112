// Files of a cycle's folder that its macros name.
#pragma once

#include "lint/Project.h"

#include <string>

namespace dotek::lint {

// The macro that CALL or #INCLUDE names, with or without its ending; nullptr: it is not in the folder.
const gibbs::Macro* calledMacro(const gibbs::Cycle& cycle, const std::string& name, const Project& project);

// The same of a CALL; nullptr also where its name is computed.
const gibbs::Macro* calledMacro(const gibbs::Cycle& cycle, const gibbs::CallMacro& call,
                                const Project& project);

} // namespace dotek::lint
