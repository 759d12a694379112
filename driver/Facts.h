// `dotek list controls NAME`: what is known of one control, and where from.
#pragma once

#include "driver/Driver.h"

#include <string>

namespace dotek::driver {

// A fact a line: section, grade, the file that states it, the fact, its source.
Outcome listFacts(const std::string& control, const CommonOptions& options);

} // namespace dotek::driver
