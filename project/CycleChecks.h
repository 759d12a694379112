// Private to the project: the checks of CycleData.mac, run on the values that are posted.
#pragma once

#include "project/CycleFolder.h"
#include "project/Fields.h"
#include "project/Session.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dotek::project {

// Names and values as a message says them: `A` = 1 with `B` = 2; none: these values.
std::string rejectedValues(const std::vector<std::pair<std::string, double>>& values);

// Whether a rejection names the fields whose values cause it, which costs many runs of the checks.
enum class Blame : std::uint8_t { Fields, Nothing };

// Reports values that the dialog would not let pass; takes over values that the macro computes.
void runCycleChecks(const CycleFolder& folder, FieldTable& fields, const std::map<std::string, double>& hosts,
                    Session& session, Blame blame = Blame::Fields);

} // namespace dotek::project
