#include "ir/Decided.h"

#include <doctest/doctest.h>

#include <vector>

using Places = std::vector<std::vector<std::size_t>>;
using Decides = std::vector<std::size_t>;

TEST_CASE("a branch decides on what stands between it and where its ways meet") {
  // 0: IF .. GOTO 2   1: A   2: B   3: end
  const Places next = {{1, 2}, {2}, {3}};
  const dotek::ir::Decided decided(next);
  CHECK(decided.by(0) == Decides{1});
  CHECK(decided.by(1).empty());
}

TEST_CASE(
    "a branch that leaves a loop decides on the loop and on itself, one within the loop on its own part") {
  // 0: A   1: IF .. GOTO 5   2: IF .. GOTO 4   3: B   4: GOTO 1   5: C
  const Places next = {{1}, {2, 5}, {3, 4}, {4}, {1}, {6}};
  const dotek::ir::Decided decided(next);
  CHECK(decided.by(1) == Decides{1, 2, 4});
  CHECK(decided.by(2) == Decides{3});
}

TEST_CASE("what ends on its own is left at its end, and an endless loop at each statement") {
  // 0: IF .. GOTO 2   1: alarm   2: A
  const Places stops = {{1, 2}, {}, {3}};
  CHECK(dotek::ir::Decided(stops).by(0) == Decides{1, 2});
  // 0: IF .. GOTO 2   1: A   2: GOTO 1
  const Places endless = {{1, 2}, {2}, {1}};
  CHECK(dotek::ir::Decided(endless).by(0) == Decides{1, 2});
}
