// The readings that `--assume` may name.
#pragma once

#include "support/Diagnostics.h"

#include <set>
#include <string>

namespace dotek::driver {

// Reports every name that no command knows: a misspelt one would else be passed over without a word.
void checkAssumptions(const std::set<std::string>& given, Diagnostics& diagnostics);

} // namespace dotek::driver
