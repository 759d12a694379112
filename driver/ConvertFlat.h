// Private to Convert*.cpp: `--var`.
#pragma once

#include "driver/Driver.h"
#include "support/Diagnostics.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dotek::driver {

// Warnings of the runs, and their lines before them: they are of the program, not of its blocks.
using FoundInRuns = std::vector<std::pair<std::string, Diagnostic>>;

// Runs the programs among the inputs with the values of --var, and puts the plain blocks of each in its place
// (CommonOptions::buffers). The outcome of a run that did not come to its end; nothing: all did.
std::optional<Outcome> takeFlat(ConvertOptions& options, FoundInRuns& found);

} // namespace dotek::driver
