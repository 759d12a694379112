// `datum` of [setup] and --datum: where the active system of a program of Mikroprog is.
#pragma once

#include "stdlib/Setup.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

namespace dotek::stdlib {

// It is a zero of the setup with this number instead of that of a work system; Y that was not given, as on a
// lathe, is no number.
inline constexpr std::uint32_t kDatum = 99;
inline constexpr double kNoCoordinate = std::numeric_limits<double>::infinity();

inline std::optional<Setup::Zero> datumOf(const Setup& setup) {
  const auto at = std::find_if(setup.zeros.begin(), setup.zeros.end(),
                               [](const Setup::Zero& one) { return one.system == kDatum; });
  return at == setup.zeros.end() ? std::nullopt : std::optional(*at);
}

} // namespace dotek::stdlib
