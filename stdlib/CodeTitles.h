// What the title of a code in a profile says beside what the code is for.
#pragma once

#include "stdlib/Control.h"

#include <string_view>

namespace dotek::stdlib {

// A return to the reference position so titled moves all axes where its block names none.
inline constexpr std::string_view kAllAxesTitle = "without axes all of them";
// Cutter compensation so titled goes around an outside corner on an arc.
inline constexpr std::string_view kRoundTitle = "outside corners are arcs";

inline bool returnsAllAxes(const CodeInfo& code) {
  return code.title.ends_with(kAllAxesTitle);
}
inline bool roundsCorners(const Control& control) {
  const CodeInfo* const code = control.find(Function::CutterCompLeft);
  return code != nullptr && code->title.ends_with(kRoundTitle);
}

} // namespace dotek::stdlib
