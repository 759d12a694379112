// The languages that convert writes.
#pragma once

#include <array>
#include <string_view>

namespace dotek::driver {

inline constexpr std::array<std::string_view, 1> kTargets = {"fanuc"};

} // namespace dotek::driver
