// The beginning of a control's data file: a machine that differs from one that Dotek knows.
#pragma once

#include "stdlib/Control.h"
#include "stdlib/ProbeCodes.h"

#include <string>

namespace dotek::project {

// TOML that extends `base` and states what differs: the codes of the probe where they are given, else, as
// comments, what machines differ in.
std::string draftControl(const std::string& name, const stdlib::Control& base,
                         const stdlib::ProbeCodes& probe);

} // namespace dotek::project
