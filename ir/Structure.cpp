#include "ir/Structure.h"

#include "ir/Flow.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace dotek::ir {
namespace {

using Index = std::size_t;

struct Interval {
  Index begin = 0, end = 0;
  bool holds(Index at) const { return at >= begin && at < end; }
};

// Jumps times statements: what the analysis takes at worst.
constexpr std::size_t kMostWork = 20'000'000;

// One crosses the other where they overlap and neither holds the other.
bool cross(const Interval& a, const Interval& b) {
  const bool apart = a.end <= b.begin || b.end <= a.begin;
  const bool nested = (a.begin <= b.begin && b.end <= a.end) || (b.begin <= a.begin && a.end <= b.end);
  return !apart && !nested;
}

class Analysis {
public:
  explicit Analysis(const Program& program)
      : program_(program), body_(program.body), next_(flowOf(body_).next), before_(body_.size()) {
    for (Index i = 0; i < body_.size(); ++i) {
      if (const auto* label = std::get_if<Label>(&body_[i].node)) places_.try_emplace(label->label, i);
      for (const Index to : next_[i])
        if (to < body_.size()) before_[to].push_back(i);
    }
  }

  Structure run() {
    Structure out;
    out.refused = refusal();
    if (!out.refused) out.refused = loops();
    if (out.refused) return out;
    for (const Interval& loop : loops_)
      out.regions.push_back({Region::Kind::Loop, loop.begin, loop.end, loop.end});
    branches(out.regions);
    std::stable_sort(out.regions.begin(), out.regions.end(), [](const Region& a, const Region& b) {
      return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
    });
    return out;
  }

private:
  // The label that the statement jumps to, by a jump of the text.
  std::optional<LabelId> targetOf(Index at) const { return ir::targetOf(body_[at]); }
  std::optional<Index> placeOf(LabelId label) const {
    const auto found = places_.find(label);
    return found == places_.end() ? std::nullopt : std::optional(found->second);
  }
  Unstructured refuse(std::string reason, Index at) const {
    return {std::move(reason), body_[at].origin.range()};
  }

  // ---- what no structure can say

  std::optional<Unstructured> refusal() {
    std::size_t jumps = 0;
    for (Index i = 0; i < body_.size(); ++i)
      if (targetOf(i)) ++jumps;
    if (jumps * body_.size() > kMostWork)
      return refuse("the program is too long to look for its structure", 0);
    std::map<std::uint64_t, int> numbers;
    for (const ProgramStatement& statement : body_) {
      const auto* label = std::get_if<Label>(&statement.node);
      if (label != nullptr && label->label < program_.labels.size())
        ++numbers[program_.labels[label->label].number];
    }
    for (Index i = 0; i < body_.size(); ++i) {
      if (const auto* computed = std::get_if<JumpTo>(&body_[i].node))
        return refuse(constantValue(computed->number) == nullptr ? "the number of this GOTO is computed"
                                                                 : "no block has the number of this GOTO",
                      i);
      const auto target = targetOf(i);
      if (!target) continue;
      if (*target >= program_.labels.size() || !placeOf(*target))
        return refuse("the target of this jump is nowhere", i);
      const std::uint64_t number = program_.labels[*target].number;
      if (number != 0 && numbers[number] > 1)
        return refuse("several blocks are N" + std::to_string(number) + ", where this jump goes", i);
    }
    return std::nullopt;
  }

  // ---- loops

  std::optional<Unstructured> loops() {
    std::vector<Index> open;
    for (Index i = 0; i < body_.size(); ++i) {
      if (std::holds_alternative<Loop>(body_[i].node)) open.push_back(i);
      if (!std::holds_alternative<LoopEnd>(body_[i].node)) continue;
      if (open.empty()) return refuse("this END has no DO", i);
      loops_.push_back({open.back(), i + 1});
      open.pop_back();
    }
    if (!open.empty()) return refuse("this DO has no END", open.back());
    for (Index i = 0; i < body_.size(); ++i) {
      const auto target = targetOf(i);
      const auto place = target ? placeOf(*target) : std::nullopt;
      if (!place) continue;
      for (const Interval& loop : loops_)
        if (loop.holds(*place) && !loop.holds(i)) return refuse("this jump goes into a loop", i);
    }
    if (auto refused = reducible()) return refused;
    return jumpLoops();
  }

  // Reverse postorder of what is reached, and the immediate dominators along it.
  void dominators() {
    order_.assign(body_.size(), body_.size());
    std::vector<Index> post;
    std::vector<std::pair<Index, std::size_t>> stack;
    std::vector<bool> seen(body_.size());
    const auto push = [&](Index at) {
      if (at >= body_.size() || seen[at]) return;
      seen[at] = true;
      stack.emplace_back(at, 0);
    };
    push(0);
    while (!stack.empty()) {
      const Index at = stack.back().first;
      if (stack.back().second == next_[at].size()) {
        post.push_back(at);
        stack.pop_back();
      } else {
        push(next_[at][stack.back().second++]);
      }
    }
    std::reverse(post.begin(), post.end());
    reached_ = post;
    for (std::size_t i = 0; i < reached_.size(); ++i)
      order_[reached_[i]] = i;
    dominator_.assign(body_.size(), body_.size());
    if (reached_.empty()) return;
    dominator_[0] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (const Index at : reached_) {
        if (at == 0) continue;
        Index common = body_.size();
        for (const Index from : before_[at]) {
          if (dominator_[from] == body_.size()) continue;
          common = common == body_.size() ? from : meet(from, common);
        }
        if (dominator_[at] == common) continue;
        dominator_[at] = common;
        changed = true;
      }
    }
  }
  Index meet(Index a, Index b) const {
    while (a != b) {
      while (order_[a] > order_[b])
        a = dominator_[a];
      while (order_[b] > order_[a])
        b = dominator_[b];
    }
    return a;
  }
  bool dominates(Index a, Index b) const {
    while (order_[b] > order_[a])
      b = dominator_[b];
    return a == b;
  }

  // Each path back leads to a statement that all paths to its source pass.
  std::optional<Unstructured> reducible() {
    dominators();
    for (const Index from : reached_) {
      for (const Index to : next_[from]) {
        if (to >= body_.size() || order_[to] > order_[from]) continue;
        if (!dominates(to, from)) return refuse("the loop that this jump closes has a second entry", from);
        back_[to].push_back(from);
      }
    }
    return std::nullopt;
  }

  // Loops that are made of jumps backward.
  std::optional<Unstructured> jumpLoops() {
    const std::vector<Interval> whiles = loops_;
    for (const auto& [header, sources] : back_) {
      const bool ofWhile = std::any_of(sources.begin(), sources.end(), [&](Index from) {
        return std::holds_alternative<LoopEnd>(body_[from].node);
      });
      if (ofWhile) continue;
      std::set<Index> members = {header};
      std::vector<Index> open = sources;
      while (!open.empty()) {
        const Index at = open.back();
        open.pop_back();
        if (!members.insert(at).second) continue;
        for (const Index from : before_[at])
          if (order_[from] < body_.size()) open.push_back(from);
      }
      if (*members.begin() < header)
        return refuse("the loop that this jump closes begins after a part of it", sources.front());
      const Interval loop{header, *members.rbegin() + 1};
      if (const auto from = entrance(loop))
        return refuse("this jump goes into a loop that is made of jumps", *from);
      for (const Interval& other : loops_)
        if (cross(loop, other))
          return refuse("the loop that this jump closes crosses another", sources.front());
      loops_.push_back(loop);
    }
    return std::nullopt;
  }

  // A statement outside that leads into the interval after its begin. What nothing reaches counts, too: it
  // is in the text.
  std::optional<Index> entrance(const Interval& region) const {
    for (Index at = region.begin + 1; at < region.end; ++at)
      for (const Index from : before_[at])
        if (!region.holds(from)) return from;
    return std::nullopt;
  }

  // ---- branches

  // Nothing leads into it from outside, and no loop ends within it that begins before it.
  bool isRegion(const Interval& region) const {
    return !entrance(region) && std::none_of(loops_.begin(), loops_.end(),
                                             [&](const Interval& loop) { return cross(region, loop); });
  }

  void branches(std::vector<Region>& out) const {
    for (Index i = 0; i < body_.size(); ++i) {
      const auto* branch = std::get_if<Branch>(&body_[i].node);
      if (branch == nullptr) continue;
      const Index otherwise = *placeOf(branch->target);
      if (otherwise <= i) continue;
      // IF over an arm that ends with a jump over the other one.
      const auto over = endOfOther(i, otherwise);
      if (over && isRegion({i, *over}))
        out.push_back({Region::Kind::If, i, *over, otherwise});
      else if (isRegion({i, otherwise}))
        out.push_back({Region::Kind::If, i, otherwise, otherwise});
    }
  }

  std::optional<Index> endOfOther(Index branch, Index otherwise) const {
    Index last = otherwise - 1;
    while (last > branch && std::holds_alternative<Comment>(body_[last].node))
      --last;
    const auto* jump = std::get_if<Jump>(&body_[last].node);
    if (jump == nullptr || body_[last].blockDelete != 0) return std::nullopt;
    const auto end = placeOf(jump->target);
    return end && *end > otherwise ? end : std::nullopt;
  }

  const Program& program_;
  const std::vector<ProgramStatement>& body_;
  const std::vector<Next> next_;
  std::vector<std::vector<Index>> before_;
  std::map<LabelId, Index> places_;
  std::vector<Index> reached_, order_, dominator_;
  std::map<Index, std::vector<Index>> back_; // sources of the paths back, by where they lead
  std::vector<Interval> loops_;
};

} // namespace

Structure structureOf(const Program& program) {
  return Analysis(program).run();
}

} // namespace dotek::ir
