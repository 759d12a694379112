// Keywords of a Prog whose picture prints a decimal point.
#pragma once

#include "lint/Project.h"

#include <set>
#include <string>

namespace dotek::lint {

std::set<std::string> printedWithPoint(const compost::Program& prog);

} // namespace dotek::lint
