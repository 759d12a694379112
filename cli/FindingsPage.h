// Findings of lint as a page to read and to send.
#pragma once

#include "support/Diagnostics.h"

#include <string>

namespace dotek::cli {

// One HTML document without links to elsewhere: a summary, then each file with its findings and the lines
// that they are at. `summary`: what was read, "" where that is not said.
std::string findingsPage(const Diagnostics& diagnostics, const SourceMap& sources,
                         const std::string& summary);

} // namespace dotek::cli
