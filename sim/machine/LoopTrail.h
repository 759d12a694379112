// The jumps backwards of the last steps of a run that meets its limit: which loop it went round in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

namespace dotek::sim {

class LoopTrail {
public:
  struct Edge {
    std::uint32_t from = 0, to = 0; // places of instructions; to <= from
    friend bool operator==(const Edge&, const Edge&) = default;
  };

  // Before each instruction: how many calls are open, and its place. What a call does within the loop that
  // calls it is passed over.
  void step(std::size_t depth, std::uint32_t place) {
    taken_.reset();
    if (depth > depth_) return;
    if (depth < depth_) {
      depth_ = depth;
      last_.reset();
      edges_.clear();
    }
    if (last_ && place <= *last_) {
      edges_[place] = *last_;
      taken_ = Edge{*last_, place};
    }
    last_ = place;
  }
  void forget() { edges_.clear(); }                           // the jumps so far
  const std::optional<Edge>& taken() const { return taken_; } // by the last step
  std::size_t depth() const { return depth_; }
  // The loop that holds the others.
  std::optional<Edge> outermost() const {
    if (edges_.empty()) return std::nullopt;
    return Edge{edges_.begin()->second, edges_.begin()->first};
  }

private:
  std::size_t depth_ = SIZE_MAX;
  std::optional<std::uint32_t> last_;
  std::optional<Edge> taken_;
  std::map<std::uint32_t, std::uint32_t> edges_; // by where they lead to: the last from where
};

} // namespace dotek::sim
