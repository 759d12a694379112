#include "frontend/gibbs/LowerWays.h"

#include "frontend/gibbs/Program.h"

namespace dotek::frontend::gibbs {

Ways::Id Ways::add() {
  ends_.emplace_back();
  codes_.push_back(kNowhere);
  return static_cast<Id>(ends_.size() - 1);
}

Ways::Id Ways::after(Id from) {
  const Id to = add();
  join(from, to);
  return to;
}

Ways::Id Ways::afterDialog(Id from) {
  ends_[from].passes = true;
  const Id to = add();
  edges_.push_back({from, to, false});
  return to;
}

void Ways::sortBack(bool shownOnly, std::vector<std::size_t>& starts, std::vector<Id>& origins) const {
  starts.assign(ends_.size() + 2, 0);
  for (const Edge& edge : edges_)
    if (edge.shown || !shownOnly) ++starts[edge.to + 2];
  for (std::size_t i = 2; i < starts.size(); ++i)
    starts[i] += starts[i - 1];
  origins.resize(starts.back());
  for (const Edge& edge : edges_)
    if (edge.shown || !shownOnly) origins[starts[edge.to + 1]++] = edge.from;
}

void Ways::endsBehind(std::map<std::size_t, PathEnds>& behind) const {
  if (messages_.empty()) return;
  std::vector<std::size_t> starts;
  std::vector<Id> origins;
  sortBack(true, starts, origins);
  for (bool PathEnds::*end : {&PathEnds::passes, &PathEnds::rejects}) {
    std::vector<bool> leads(ends_.size(), false);
    std::vector<Id> open;
    for (Id way = 0; way < ends_.size(); ++way) {
      if (!(ends_[way].*end)) continue;
      leads[way] = true;
      open.push_back(way);
    }
    while (!open.empty()) {
      const Id way = open.back();
      open.pop_back();
      for (std::size_t i = starts[way]; i < starts[way + 1]; ++i) {
        if (leads[origins[i]]) continue;
        leads[origins[i]] = true;
        open.push_back(origins[i]);
      }
    }
    for (const auto& [way, message] : messages_)
      if (leads[way]) behind[message].*end = true;
  }
}

void Ways::codesOf(std::map<std::size_t, std::set<std::size_t>>& codes) const {
  if (rejected_.empty()) return;
  std::vector<std::size_t> starts;
  std::vector<Id> origins;
  sortBack(false, starts, origins);
  for (const auto& [place, rejected] : rejected_) {
    std::set<std::size_t>& found = codes[place];
    std::vector<bool> seen(ends_.size(), false);
    std::vector<Id> open;
    const auto look = [&](Id way) {
      if (seen[way]) return;
      seen[way] = true;
      open.push_back(way);
    };
    for (const Id way : rejected)
      look(way);
    while (!open.empty()) {
      const Id way = open.back();
      open.pop_back();
      // Only the first way has none before it.
      if (codes_[way] != kNowhere || starts[way] == starts[way + 1]) {
        found.insert(codes_[way]);
        continue;
      }
      for (std::size_t i = starts[way]; i < starts[way + 1]; ++i)
        look(origins[i]);
    }
  }
}

} // namespace dotek::frontend::gibbs
