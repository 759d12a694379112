// What lint says of its findings as a whole.
#pragma once

#include "support/Diagnostics.h"

#include <string>

namespace dotek::cli {

// "12 findings in 3 files (2 errors); 4 can be repaired with --fix"; "" where there is none.
std::string closingLine(const Diagnostics& findings);

// How often each code is found, most often first: number, severity, code.
std::string statisticsOf(const Diagnostics& findings);

} // namespace dotek::cli
