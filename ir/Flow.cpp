#include "ir/Flow.h"

#include <unordered_map>

namespace dotek::ir {

std::vector<std::vector<std::size_t>> successors(const std::vector<Statement>& list) {
  std::unordered_map<LabelId, std::size_t> places;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (const auto* label = std::get_if<Label>(&list[i].node)) places.try_emplace(label->label, i);

  std::vector<std::vector<std::size_t>> out(list.size());
  const auto jump = [&](std::size_t from, LabelId target) {
    const auto found = places.find(target);
    if (found == places.end()) return; // verify() tells
    if (out[from].empty() || out[from].front() != found->second) out[from].push_back(found->second);
  };
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& node = list[i].node;
    if (const auto* go = std::get_if<Jump>(&node)) {
      jump(i, go->target);
    } else if (std::holds_alternative<Return>(node)) {
      out[i].push_back(list.size());
    } else if (!std::holds_alternative<Alarm>(node)) {
      out[i].push_back(i + 1);
      if (const auto* branch = std::get_if<Branch>(&node)) jump(i, branch->target);
    }
  }
  return out;
}

std::vector<bool> reachable(const std::vector<Statement>& list) {
  const auto next = successors(list);
  std::vector<bool> seen(list.size());
  std::vector<std::size_t> open;
  const auto visit = [&](std::size_t at) {
    if (at >= list.size() || seen[at]) return;
    seen[at] = true;
    open.push_back(at);
  };
  visit(0);
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::size_t to : next[at])
      visit(to);
  }
  return seen;
}

} // namespace dotek::ir
