// Macros whose text is there, with the variables that they keep at power off elsewhere: `dotek@900` is the
// set `dotek` with #900 and following in place of #520 and following.
#pragma once

#include "stdlib/MacroSet.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::stdlib {

struct MovedName {
  std::string_view set;
  std::optional<std::uint32_t> first; // nothing: where its data has them
};
// nullopt: `@` is not followed by a number of a common variable.
std::optional<MovedName> movedName(std::string_view name);

// Variables that the macros keep at power off; nullopt: none.
std::optional<std::pair<std::uint32_t, std::uint32_t>> keptVariables(const MacroSet& set);

MacroSet movedTo(MacroSet set, std::uint32_t first);

// Text of the macros of the set, as `dotek new macros NAME` prints it; nullopt: there is none.
std::optional<std::string> macroText(const DataFiles& files, std::string_view name);

} // namespace dotek::stdlib
