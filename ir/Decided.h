// Which statements a branch decides on: those that run or do not run by the way that it takes.
#pragma once

#include <cstddef>
#include <vector>

namespace dotek::ir {

// `next`: the places that each statement leads to, as successors() gives them; next.size() is the end, and a
// statement without a place leads there, too. What cannot reach the end decides as if it could leave at each
// of its statements.
class Decided {
public:
  explicit Decided(const std::vector<std::vector<std::size_t>>& next);
  // Of a branch directly: the statements that always run after one of its places, and not always after the
  // branch itself. The branch is among them where it is in a loop that it ends. Ascending.
  std::vector<std::size_t> by(std::size_t branch) const;

private:
  const std::vector<std::vector<std::size_t>>& next_;
  std::vector<std::size_t>
      after_; // the next place that each statement always comes to; next_.size() of the end
};

} // namespace dotek::ir
