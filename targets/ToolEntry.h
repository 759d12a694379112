// What the tool table has when a cycle of the cycle language is called: the cycle and what is written of it
// find the same.
#pragma once

#include "verify/Draw.h"

#include <cstdint>
#include <vector>

namespace dotek::targets {

struct VerifyPlan;

// An offset that the case names, mm, beside its length. Each has some wear: a program that sets a whole and
// leaves that differs.
struct ToolEntry {
  std::uint32_t number = 1;
  double lengthWear = 0.125;
  double radius = 6; // without its wear
  double radiusWear = -0.0625;
};
std::vector<ToolEntry> toolEntries(const VerifyPlan& plan, const verify::Case& drawn);

} // namespace dotek::targets
