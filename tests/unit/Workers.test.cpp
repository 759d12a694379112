// Test cases over several processes: what is counted, and what a case that ends its process is.
#include "tests/Workers.h"

#include <cstdlib>
#include <doctest/doctest.h>

using namespace dotek::tests;

TEST_CASE("workers: every case runs once, and one that ends its process has failed") {
  const auto name = [](unsigned i) { return "case " + std::to_string(i); };
  const auto one = [](unsigned i) {
    if (i == 3) std::_Exit(7);
    Totals out;
    out.ran = 1;
    out.failed = i == 5 ? 1 : 0;
    out.goldens = static_cast<int>(i);
    return out;
  };
  for (const unsigned jobs : {1U, 2U, 5U}) {
    const Totals all = runInProcesses(jobs, 10, one, name);
    CHECK(all.ran == 10);
    CHECK(all.failed == 2);
    CHECK(all.goldens == 0 + 1 + 2 + 4 + 5 + 6 + 7 + 8 + 9);
  }
}
