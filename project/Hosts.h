// Host inputs: what the CAM knows of an operation and the macro does not say. No value is built in.
#pragma once

#include "project/Options.h"
#include "support/Diagnostics.h"

#include <map>
#include <string>

namespace dotek::project {

// The nearest known name of a host input; "" for none.
std::string nearestHost(const std::string& name);

// The values of `--host` and `--clearance`; a name outside the table or a text that is no number is a usage
// error.
std::map<std::string, double> parseHosts(const NamedTexts& given, Diagnostics& diagnostics);

} // namespace dotek::project
