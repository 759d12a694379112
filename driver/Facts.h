// `dotek list controls NAME` and `dotek list macros NAME`: what is known of one of them, and where from.
#pragma once

#include "driver/Driver.h"

#include <string>

namespace dotek::driver {

// Of `controls` a fact a line: section, grade, the file that states it, the fact, its source. Of `macros`
// each call with what its letters mean, and the letters that exclude each other. Another `what` is refused.
Outcome listFacts(const std::string& what, const std::string& name, const CommonOptions& options);

} // namespace dotek::driver
