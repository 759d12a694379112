// What a program does with the contact of one G31 as it runs on, past the next ones.
#pragma once

#include "lint/NcProgram.h"

#include <cstddef>
#include <optional>
#include <set>

namespace dotek::lint {

struct ContactUse {
  bool asked = false;           // a condition or an argument of a call has a value that comes from it
  bool leadsOn = false;         // it is the way to a later G31 alone, whose contact takes its variables
  std::set<std::uint32_t> held; // variables that have such a value at some place
};

// Follows what comes from the contact of the G31 with this index until it is written over. A later G31 whose
// target comes from it carries it on. Common variables are followed into the next run of the program. Each
// statement that is looked at takes one of `steps`. nullopt: they are used up, or a computed jump leads
// anywhere.
std::optional<ContactUse> contactUse(const NcProgram& nc, std::size_t skip, std::size_t& steps);

} // namespace dotek::lint
