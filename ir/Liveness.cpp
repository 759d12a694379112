#include "ir/Liveness.h"

#include "ir/Flow.h"
#include "ir/Walk.h"

namespace dotek::ir {

std::set<VariableId> liveAtEntry(const std::vector<CycleStatement>& list, const std::set<VariableId>& after) {
  if (list.empty()) return after;
  const auto next = successors(list);
  std::vector<std::set<VariableId>> live(list.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = list.size(); i-- > 0;) {
      std::set<VariableId> now;
      for (const std::size_t to : next[i]) {
        const std::set<VariableId>& there = to < list.size() ? live[to] : after;
        now.insert(there.begin(), there.end());
      }
      if (const auto* assign = std::get_if<Assign>(&list[i].node)) now.erase(assign->variable);
      eachNode(list[i], [&](const Expression& node) {
        if (const auto* use = std::get_if<VariableUse>(&node.node)) now.insert(use->variable);
      });
      if (now == live[i]) continue;
      live[i] = std::move(now);
      changed = true;
    }
  }
  return live.front();
}

} // namespace dotek::ir
