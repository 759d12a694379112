// The languages that convert writes.
#pragma once

#include <array>
#include <string_view>

namespace dotek::driver {

inline constexpr std::array<std::string_view, 2> kTargets = {"fanuc", "fusion"};

} // namespace dotek::driver
