// The version of Dotek, as `--version`, SARIF and reports say it. CMakeLists.txt reads it here, and the
// package has it from the program.
#pragma once

#include <string_view>

namespace dotek {

inline constexpr std::string_view kVersion = "0.1.0";

} // namespace dotek
