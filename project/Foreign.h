// Programs of other controls, for the one message about such a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dotek::project {

// The language of another control.
struct Foreign {
  std::string name;   // "Okuma OSP"
  std::string lines;  // that show it: "line 3 `VC1=2`, line 7 `NOEX VC2=0` and 4 more"
  std::string remedy; // what corresponds in Macro B; "" where nothing does
};

// `bytes`: the beginning of a file that recognise() takes for no input. nullopt: not for that reason.
std::optional<Foreign> foreignLanguage(std::string_view bytes);

} // namespace dotek::project
