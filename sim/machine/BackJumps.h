// Where the jumps of a program lead, asked for a piece of its text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dotek::sim {

class BackJumps {
public:
  // Statements by their place in the program; in the order of `at`.
  void add(std::size_t at, std::size_t target) {
    at_.push_back(at);
    least_.push_back(target);
  }
  // After the last add().
  void close() {
    // A tree of minima above the targets: of place i are 2i and 2i + 1.
    least_.insert(least_.begin(), at_.size(), kNone);
    for (std::size_t i = at_.size(); i-- > 1;)
      least_[i] = std::min(least_[2 * i], least_[2 * i + 1]);
  }
  static constexpr std::size_t kNone = SIZE_MAX;
  // The first statement that a jump from after `first` and before `last` leads to; kNone: there is no jump.
  std::size_t leastTarget(std::size_t first, std::size_t last) const {
    const auto place = [&](auto at) { return static_cast<std::size_t>(at - at_.begin()); };
    std::size_t left = place(std::upper_bound(at_.begin(), at_.end(), first)) + at_.size();
    std::size_t right = place(std::lower_bound(at_.begin(), at_.end(), last)) + at_.size();
    std::size_t out = kNone;
    for (; left < right; left /= 2, right /= 2) {
      if (left % 2 == 1) out = std::min(out, least_[left++]);
      if (right % 2 == 1) out = std::min(out, least_[--right]);
    }
    return out;
  }

private:
  std::vector<std::size_t> at_, least_;
};

} // namespace dotek::sim
