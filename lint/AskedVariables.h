// Variables that programs look at: what they compare, and what they hand to others.
#pragma once

#include "ir/Program.h"
#include "lint/Project.h"

#include <cstdint>
#include <map>
#include <set>

namespace dotek::lint {

// In conditions and calls of the program.
std::set<std::uint32_t> askedIn(const ir::Program& program);

// How many programs of the files ask for each variable. Computed once a project.
using Askers = std::map<std::uint32_t, std::size_t>;
Askers collectAskers(const Project& project);
const Askers& askersOf(const Project& project);

} // namespace dotek::lint
