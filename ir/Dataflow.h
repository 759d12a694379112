// Facts that hold before each statement of a list on every path to it.
#pragma once

#include "ir/Flow.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

namespace dotek::ir {

// The fact before each statement; nothing where no path leads. `transfer(index, fact)` gives the fact after
// a statement, `meet(into, other)` what holds on both paths and whether `into` changed. A fact may change a
// bounded number of times only.
template <class Fact, AnyStatement Statement, class Transfer, class Meet>
std::vector<std::optional<Fact>> factsBefore(const std::vector<Statement>& list, Fact entry,
                                             const Transfer& transfer, const Meet& meet) {
  const auto next = successors(list);
  std::vector<std::optional<Fact>> facts(list.size());
  if (list.empty()) return facts;
  // The first in the text first: along jumps forward each is looked at once.
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> open;
  std::vector<bool> waits(list.size());
  open.push(0);
  facts[0] = std::move(entry);
  while (!open.empty()) {
    const std::size_t at = open.top();
    open.pop();
    waits[at] = false;
    for (const std::size_t to : next[at]) {
      if (to >= list.size()) continue;
      Fact behind = transfer(at, to, *facts[at]);
      bool changed = !facts[to];
      if (changed)
        facts[to] = std::move(behind);
      else
        changed = meet(*facts[to], behind);
      if (!changed || waits[to]) continue;
      waits[to] = true;
      open.push(to);
    }
  }
  return facts;
}

} // namespace dotek::ir
