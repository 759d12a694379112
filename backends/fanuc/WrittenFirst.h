// Whether a variable has its value from the program itself where it is read. What the control keeps at power
// off makes no difference then. Private to Program*.cpp and Cycle*.cpp.
#pragma once

#include "ir/Flow.h"

#include <cstddef>
#include <vector>

namespace dotek::backends::fanuc {

// For each statement whether a way leads to it on which none that `writes` came before. `flow`: of the list.
template <class Statement, class Writes>
std::vector<bool> reachedUnwritten(const std::vector<Statement>& list, const ir::ProgramFlow& flow,
                                   const Writes& writes) {
  bool computed = false; // a computed jump was reached
  std::vector<bool> reached(list.size(), false);
  std::vector<std::size_t> open;
  const auto reach = [&](std::size_t at) {
    if (at >= list.size() || reached[at]) return;
    reached[at] = true;
    open.push_back(at);
  };
  reach(0);
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    if (writes(list[at])) continue;
    for (const std::size_t next : flow.next[at])
      reach(next);
    if (computed || !ir::isComputedJump(list[at])) continue;
    computed = true;
    for (const std::size_t next : flow.labels)
      reach(next);
  }
  return reached;
}

} // namespace dotek::backends::fanuc
