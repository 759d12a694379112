#include "ir/Decided.h"

#include <algorithm>
#include <utility>

namespace dotek::ir {

namespace {

// Immediate postdominators, by the iteration of Cooper, Harvey and Kennedy on the graph turned around.
class Postdominators {
public:
  explicit Postdominators(const std::vector<std::vector<std::size_t>>& next)
      : end_(next.size()), ways_(next), from_(next.size() + 1), number_(next.size() + 1, kNone),
        after_(next.size() + 1, kNone) {}

  std::vector<std::size_t> run() {
    leaveLoops();
    for (std::size_t at = 0; at < end_; ++at)
      for (const std::size_t to : ways_[at])
        from_[to].push_back(at);
    order();
    after_[end_] = end_;
    for (bool changed = true; changed;) {
      changed = false;
      for (auto at = postorder_.rbegin(); at != postorder_.rend(); ++at)
        changed = (*at != end_ && settle(*at)) || changed;
    }
    return std::move(after_);
  }

private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  // Statements without a way to the end get one.
  void leaveLoops() {
    std::vector<std::vector<std::size_t>> from(end_ + 1);
    for (std::size_t at = 0; at < end_; ++at) {
      if (ways_[at].empty()) ways_[at].push_back(end_);
      for (const std::size_t to : ways_[at])
        from[to].push_back(at);
    }
    std::vector<bool> seen(end_ + 1, false);
    std::vector<std::size_t> open = {end_};
    seen[end_] = true;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for (const std::size_t one : from[at]) {
        if (seen[one]) continue;
        seen[one] = true;
        open.push_back(one);
      }
    }
    for (std::size_t at = 0; at < end_; ++at)
      if (!seen[at]) ways_[at].push_back(end_);
  }

  // Postorder of the graph that is turned around, from the end.
  void order() {
    std::vector<std::pair<std::size_t, std::size_t>> open = {{end_, 0}};
    std::vector<bool> seen(end_ + 1, false);
    seen[end_] = true;
    while (!open.empty()) {
      auto& [at, child] = open.back();
      if (child == from_[at].size()) {
        number_[at] = postorder_.size();
        postorder_.push_back(at);
        open.pop_back();
        continue;
      }
      const std::size_t one = from_[at][child++];
      if (seen[one]) continue;
      seen[one] = true;
      open.emplace_back(one, 0);
    }
  }

  bool settle(std::size_t at) {
    std::size_t common = kNone;
    for (const std::size_t to : ways_[at]) {
      if (after_[to] == kNone) continue;
      common = common == kNone ? to : meet(common, to);
    }
    return common != kNone && std::exchange(after_[at], common) != common;
  }

  std::size_t meet(std::size_t one, std::size_t other) const {
    while (one != other) {
      while (number_[one] < number_[other])
        one = after_[one];
      while (number_[other] < number_[one])
        other = after_[other];
    }
    return one;
  }

  std::size_t end_;
  std::vector<std::vector<std::size_t>> ways_, from_;
  std::vector<std::size_t> number_, postorder_, after_;
};

} // namespace

Decided::Decided(const std::vector<std::vector<std::size_t>>& next)
    : next_(next), after_(Postdominators(next).run()) {}

std::vector<std::size_t> Decided::by(std::size_t branch) const {
  std::vector<std::size_t> out;
  if (next_[branch].size() < 2) return out;
  for (const std::size_t place : next_[branch])
    for (std::size_t at = place; at != after_[branch] && at < next_.size(); at = after_[at])
      out.push_back(at);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

} // namespace dotek::ir
