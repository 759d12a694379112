// How many random cases a test draws.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <vector>

namespace dotek::tests {

// The sanitizers are on: a case takes about ten times as long.
bool fewDraws();

// `count`; under the sanitizers a twentieth of it, but not less than `least` (or `count`, where that is
// less).
template <std::integral T> T draws(T count, T least = 20) {
  return fewDraws() ? std::max<T>(std::min(count, least), count / 20) : count;
}

// Of variants of one kind all; under the sanitizers, which look for other faults than the test does, the
// first and each third after it.
template <class T> std::vector<T> someOf(std::vector<T> all) {
  if (!fewDraws()) return all;
  std::vector<T> out;
  for (std::size_t i = 0; i < all.size(); i += 3)
    out.push_back(all[i]);
  return out;
}

} // namespace dotek::tests
