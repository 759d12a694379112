// The languages that convert writes.
#pragma once

#include <array>
#include <string_view>

namespace dotek::driver {

inline constexpr std::array<std::string_view, 3> kTargets = {"fanuc", "mikroprog", "fusion"};
// What `list targets` says of each.
inline constexpr std::array<std::string_view, 3> kTargetTexts = {
    "program that is called with G65", "program without arguments, for Mikroprog", "part of a Fusion post"};

} // namespace dotek::driver
