// Talks to `dotek lsp` as an editor does.
#pragma once

#include "bench/Process.h"

#include <string>

namespace bench {

// From a change of the file's text to its findings: median of `runs` changes, after the first one; no memory.
// The status is -1 where the server gave none.
Figures measureChanges(const std::string& dotek, const std::string& file, const std::string& language,
                       int runs);

} // namespace bench
