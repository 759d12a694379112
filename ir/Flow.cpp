#include "ir/Flow.h"

#include <algorithm>
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
    } else if (const auto* end = std::get_if<LoopEnd>(&node)) {
      jump(i, end->begin);
    } else if (const auto* number = std::get_if<JumpTo>(&node)) {
      for (const auto& [label, place] : places)
        if (number->number) out[i].push_back(place);
      std::sort(out[i].begin(), out[i].end());
    } else if (std::holds_alternative<Exit>(node)) {
      out[i].push_back(list.size());
    } else if (!std::holds_alternative<Alarm>(node) && !std::holds_alternative<Raise>(node)) {
      out[i].push_back(i + 1);
      if (const auto* loop = std::get_if<Loop>(&node); loop && loop->condition) jump(i, loop->end);
      if (const auto* branch = std::get_if<Branch>(&node)) jump(i, branch->target);
    }
    // Block delete leaves a statement out.
    if (list[i].blockDelete != 0 && std::find(out[i].begin(), out[i].end(), i + 1) == out[i].end())
      out[i].push_back(i + 1);
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
