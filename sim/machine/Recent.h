// Answers that are kept for the same question asked again: the part is as it was.
#pragma once

#include "sim/geometry/Point.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace dotek::sim {

// Of a ball, or of the probe, on a straight path.
template <class Answer> class Recent {
public:
  // What `ask()` gives, or gave for exactly this path and radius (not negative). Not every answer is kept.
  template <class Ask> const Answer& of(const Point3& from, const Point3& to, double radius, const Ask& ask) {
    if (kept_.empty()) kept_.resize(kMost);
    std::uint64_t hash = std::bit_cast<std::uint64_t>(radius);
    for (const double part : {from.x, from.y, from.z, to.x, to.y, to.z})
      hash = (hash ^ std::bit_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15u;
    Entry& entry = kept_[hash >> kShift];
    const auto same = [](const Point3& a, const Point3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
    if (entry.radius != radius || !same(entry.from, from) || !same(entry.to, to))
      entry = {from, to, radius, ask()};
    return entry.answer;
  }
  void forget() { kept_.clear(); }

private:
  static constexpr std::size_t kMost = 128;
  static constexpr int kShift = 64 - 7;
  struct Entry {
    Point3 from, to;
    double radius = -1; // of none
    Answer answer = {};
  };
  std::vector<Entry> kept_;
};

} // namespace dotek::sim
