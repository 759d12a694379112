// lint --cache: what an earlier run found, taken again where that run would see the same files.
#pragma once

#include "driver/Driver.h"

#include <string>

namespace dotek::driver {

// Where results are kept, and what they are the results of beside files.
struct LintCache {
  std::string folder;
  std::string command; // the arguments of the command line: other ones have a result of their own
  std::string build;   // of the program: another version may find other things
};

// As lint(), with options that change nothing and take no stream. A result that cannot be kept is a note of
// its own and has no influence on the status.
Outcome lint(const LintOptions& options, const LintCache& cache);

} // namespace dotek::driver
