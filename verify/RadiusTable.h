// Radii of tools among the offsets of a Record.
#pragma once

#include <cstdint>

namespace dotek::verify {

// Record::tools has the radius of tool offset n at kRadiusTable + n.
inline constexpr std::uint32_t kRadiusTable = 1000;

} // namespace dotek::verify
