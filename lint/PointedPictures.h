// Keywords of a Prog whose picture prints a decimal point.
#pragma once

#include "lint/ProgBlocks.h"
#include "lint/Project.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace dotek::lint {

// Each block that Progs print themselves, with its words and the keywords that print a point there.
void eachPointedBlock(const Project& project,
                      const std::function<void(const std::vector<ProgWord>& words,
                                               const std::set<std::string>& pointed)>& visit);

} // namespace dotek::lint
