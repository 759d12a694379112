// Calls of programs that are in the files, and what those programs need.
#pragma once

#include "lint/Skips.h"

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace dotek::lint {

struct OwnCall {
  const ir::ProgramStatement* statement = nullptr;
  std::set<std::uint32_t> given; // locals that the arguments set
};
// G65 with a number that is written out, by the number.
std::map<std::uint32_t, std::vector<OwnCall>> callsByProgram(const Project& project);

// The local that the condition asks whether it is empty, or is not; nothing: another condition.
std::optional<std::uint32_t> nullCompared(const ir::ConditionPtr& condition);
// The local that has to be empty for the condition to hold.
std::optional<std::uint32_t> nullTested(const ir::ConditionPtr& condition);
// Locals without which a call ends in an alarm: tested for #0 before the program can go two ways.
std::set<std::uint32_t> requiredLocals(const ir::Program& program);

} // namespace dotek::lint
