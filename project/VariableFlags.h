// `--var N=VALUE`.
#pragma once

#include "project/Options.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace dotek::project {

// Numbers with their values; what is none is reported.
std::vector<std::pair<std::uint32_t, double>> variablesOf(const NamedTexts& given, Diagnostics& diagnostics);

} // namespace dotek::project
