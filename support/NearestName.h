// The nearest known name, for messages about unknown ones.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

namespace dotek {

// Damerau-Levenshtein distance without case: letters changed, lost, added, or two neighbours swapped.
// Above `limit` it gives limit + 1.
std::size_t nameDistance(std::string_view a, std::string_view b, std::size_t limit);

// How often each letter is in a name, without case; others by their lowest bits.
using LetterCounts = std::array<std::uint8_t, 32>;
LetterCounts countLetters(std::string_view name);

// Keeps the nearest of the names it is offered, within a third of the length of `name` (one letter for
// names of two); of equally near ones that with the longest common beginning and end, then of the nearest
// length, then the first in byte order, so that the order of offering does not matter. Names beyond the
// first kMostOffers are not looked at: a hint is not worth seconds in a huge file.
class NearestName {
public:
  static constexpr std::size_t kMostOffers = 1000;

  explicit NearestName(std::string_view name)
      : name_(name), letters_(countLetters(name)),
        limit_(name.size() < 2 ? 0 : std::max<std::size_t>(1, name.size() / 3)) {}
  explicit NearestName(std::string&&) = delete; // the name is kept as a view

  void offer(std::string_view candidate);
  bool full() const { return offers_ >= kMostOffers; }
  // "" where none is near.
  const std::string& result() const { return best_; }

private:
  bool mayBeNear(std::string_view other) const;
  std::tuple<std::size_t, std::size_t, std::string_view> rank(std::string_view other) const;

  std::string_view name_;
  LetterCounts letters_;
  std::size_t limit_;
  std::size_t offers_ = 0;
  std::string best_;
};

// The nearest of a range of names (or of pairs whose first is the name).
template <class Names> std::string nearestName(std::string_view name, const Names& names) {
  NearestName nearest(name);
  for (const auto& candidate : names) {
    if (nearest.full()) break;
    if constexpr (requires { candidate.first; })
      nearest.offer(candidate.first);
    else
      nearest.offer(candidate);
  }
  return nearest.result();
}

} // namespace dotek
