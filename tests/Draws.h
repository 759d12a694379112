// How many random cases a test draws.
#pragma once

#include <algorithm>
#include <concepts>

namespace dotek::tests {

// The sanitizers are on: a case takes about ten times as long.
bool fewDraws();

// `count`; under the sanitizers a twentieth of it, but not less than `least` (or `count`, where that is
// less).
template <std::integral T> T draws(T count, T least = 20) {
  return fewDraws() ? std::max<T>(std::min(count, least), count / 20) : count;
}

} // namespace dotek::tests
