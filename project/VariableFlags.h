// `--var N=VALUE` and `--show N=NAME[=NOMINAL]`.
#pragma once

#include "project/Options.h"
#include "stdlib/Control.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dotek::project {

// Numbers with their values; what is none is reported.
std::vector<std::pair<std::uint32_t, double>> variablesOf(const NamedTexts& given, Diagnostics& diagnostics);

// A variable whose value at the end of a run is a result.
struct ShownVariable {
  std::uint32_t number = 0;
  std::string name;
  std::optional<double> nominal;
};
// Of common variables of the control; what is none is reported.
std::vector<ShownVariable> shownVariablesOf(const NamedTexts& given, const stdlib::Control& control,
                                            Diagnostics& diagnostics);

} // namespace dotek::project
