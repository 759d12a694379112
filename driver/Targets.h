// The languages that convert writes.
#pragma once

#include <array>
#include <string_view>

namespace dotek::driver {

inline constexpr std::array<std::string_view, 2> kTargets = {"fanuc", "mikroprog"};
// What `list targets` says of each.
inline constexpr std::array<std::string_view, 2> kTargetTexts = {"program that is called with G65",
                                                                 "program without arguments, for Mikroprog"};

} // namespace dotek::driver
