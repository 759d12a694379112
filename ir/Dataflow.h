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

// The fact before each statement; nothing where no path leads. `transfer(index, to, fact)` gives the fact
// after a statement where the path goes on to `to`; of a computed jump it is asked once for all its labels.
// `meet(into, other)` makes of `into` what holds on both paths and says whether it changed. A fact may change
// a bounded number of times only.
// `flow` is that of the list.
template <class Fact, AnyStatement Statement, class Transfer, class Meet>
std::vector<std::optional<Fact>> factsBefore(const std::vector<Statement>& list, const ProgramFlow& flow,
                                             Fact entry, const Transfer& transfer, const Meet& meet) {
  std::vector<std::optional<Fact>> facts(list.size());
  if (list.empty()) return facts;
  // The first in the text first: along jumps forward each is looked at once. The last of all are the labels,
  // with what holds after each of the computed jumps.
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> open;
  std::vector<bool> waits(list.size());
  std::optional<Fact> computed;
  bool computedWaits = false;
  const auto join = [&](std::optional<Fact>& into, Fact fact) {
    if (into) return static_cast<bool>(meet(*into, fact));
    into = std::move(fact);
    return true;
  };
  const auto arrive = [&](std::size_t to, Fact fact) {
    if (to >= list.size() || !join(facts[to], std::move(fact)) || waits[to]) return;
    waits[to] = true;
    open.push(to);
  };
  arrive(0, std::move(entry));
  while (!open.empty() || computedWaits) {
    if (open.empty()) {
      computedWaits = false;
      for (const std::size_t label : flow.labels)
        arrive(label, *computed);
      continue;
    }
    const std::size_t at = open.top();
    open.pop();
    waits[at] = false;
    for (const std::size_t to : flow.next[at])
      if (to < list.size()) arrive(to, transfer(at, to, *facts[at]));
    if (flow.labels.empty() || !isComputedJump(list[at])) continue;
    if (join(computed, transfer(at, flow.labels.front(), *facts[at]))) computedWaits = true;
  }
  return facts;
}

template <class Fact, AnyStatement Statement, class Transfer, class Meet>
std::vector<std::optional<Fact>> factsBefore(const std::vector<Statement>& list, Fact entry,
                                             const Transfer& transfer, const Meet& meet) {
  return factsBefore(list, flowOf(list), std::move(entry), transfer, meet);
}

} // namespace dotek::ir
