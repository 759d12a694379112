// Values of parameters as a command line gives them: `diameter=30`, `diameter=1.2in`, `side=inside`.
#pragma once

#include "frontend/cycle/Ast.h"
#include "project/Options.h"
#include "support/Diagnostics.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::project {

// In mm, degrees, mm/min or seconds: a number without a unit is in these, or has that of its parameter. A
// flag is 0 or 1, a choice the place of its name in the list, from 1, a work offset its G number. nullopt:
// `wants` says what would be right.
std::optional<double> cycleValue(const frontend::cycle::Type& type, std::string_view text,
                                 std::string& wants);

// Of --set, by the names of the cycle's parameters; names that it does not have and values that are none are
// reported.
std::map<std::string, double> cycleValues(const frontend::cycle::File& file, const NamedTexts& given,
                                          Diagnostics& diagnostics);

} // namespace dotek::project
