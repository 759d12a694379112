// What the numbers of variables mean on two controls. Private to Program*.cpp.
#pragma once

#include "ir/Expression.h"
#include "stdlib/Control.h"

#include <cstdint>
#include <optional>
#include <string>

namespace dotek::backends::fanuc {

// How a variable of one control is written on another.
struct VariableThere {
  std::optional<std::uint32_t> number; // nothing: refused
  std::string what;                    // "X of the work offset of G56"; "" of locals and common variables
  std::string why;                     // of a refusal: "is no variable of Fanuc 0i-MD"
  bool onlyKeptOtherwise = false;      // of a refusal: both have it, and one loses it at power off
  bool lost = false;                   // that one is the target
};
VariableThere variableThere(std::uint32_t number, const stdlib::Control& from, const stdlib::Control& to);

// Every number that the source's profile knows means the same on the target.
bool sameVariables(const stdlib::Control& from, const stdlib::Control& to);
// Every local and common variable of the source is one of the target, kept as long.
bool holdsVariablesOf(const stdlib::Control& to, const stdlib::Control& from);

// Both have the variable, and those that follow it on the source, at least 50 of them or all, kept as long.
bool sharesVariablesFrom(std::uint32_t first, const stdlib::Control& to, const stdlib::Control& from);

// "#1 to #33, #100 to #149"
std::string variableRanges(const stdlib::Control& control);

} // namespace dotek::backends::fanuc
