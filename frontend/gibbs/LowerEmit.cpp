#include "frontend/gibbs/LowerEmit.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dotek::frontend::gibbs {
namespace {

class Emitter {
public:
  Emitter(const Flat& flat, const WalkResult& walk, const EmitOptions& options, ir::Cycle& cycle)
      : flat_(flat), walk_(walk), options_(options), cycle_(cycle) {}

  std::vector<ir::CycleStatement> run() {
    const std::size_t size = flat_.steps.size();
    for (const ir::VariableId id : walk_.unset) {
      if (options_.unsetZero || id == flat_.returnCode) zero(id, {});
    }
    starts_.assign(3 * size + 1, 0); // steps, the end, two marks for each step
    for (std::size_t at = 0; at < size; ++at) {
      starts_[at] = out_.size();
      if (walk_.reached[at]) emit(at);
    }
    starts_[size] = out_.size();
    shortenAll();
    return placed();
  }

private:
  void add(decltype(ir::CycleStatement::node) node, SourceRange range, std::size_t target = kNowhere) {
    out_.push_back({statementOf(std::move(node), range), target, false});
  }

  void zero(ir::VariableId id, SourceRange range) {
    out_.push_back({statementOf(ir::Assign{id, ir::constant(0, range, "0")}, range, "not set counts as 0"),
                    kNowhere, false});
  }

  void emit(std::size_t at) {
    const FlatStep& here = flat_.steps[at];
    if (const auto* s = std::get_if<FlatAssign>(&here.step))
      add(ir::Assign{s->variable, s->value}, here.range);
    if (const auto* s = std::get_if<FlatUnset>(&here.step);
        s != nullptr && options_.unsetZero && walk_.unset.contains(s->variable))
      zero(s->variable, here.range);
    if (const auto* s = std::get_if<FlatJump>(&here.step)) add(ir::Jump{}, here.range, s->target);
    if (const auto* s = std::get_if<FlatBranch>(&here.step)) {
      if (walk_.jumps[at] && walk_.falls[at]) add(ir::Branch{s->condition, 0}, here.range, s->target);
      if (walk_.jumps[at] && !walk_.falls[at]) add(ir::Jump{}, here.range, s->target);
    }
    if (const auto* s = std::get_if<FlatMessage>(&here.step)) {
      if (options_.alarms.contains(at))
        add(ir::Alarm{s->text}, here.range);
      else
        add(ir::Comment{s->text}, here.range);
    }
    if (const auto* s = std::get_if<FlatMove>(&here.step); s != nullptr && options_.move) {
      for (Emitted& each : options_.move(at, *s)) {
        if (each.mark)
          starts_[each.target] = out_.size();
        else
          out_.push_back(std::move(each));
      }
    }
    if (const auto* s = std::get_if<FlatEnd>(&here.step)) {
      if (s->rejects)
        add(ir::Alarm{}, here.range);
      else
        add(ir::Jump{}, here.range, flat_.steps.size());
    }
    if (const auto* s = std::get_if<FlatReturn>(&here.step)) emitReturn(at, *s);
  }

  void emitReturn(std::size_t at, const FlatReturn& s) {
    const auto found = walk_.ends.find(at);
    const WalkResult::Ends ends = found == walk_.ends.end() ? WalkResult::Ends{true, false} : found->second;
    if (!ends.rejects) return add(ir::Jump{}, {}, flat_.steps.size());
    if (ends.passes) {
      add(ir::Branch{ir::compare(ir::Relation::Equal, ir::variable(s.code), ir::constant(0, {}, "0")), 0}, {},
          flat_.steps.size());
    }
    ir::CycleStatement alarm = statementOf(ir::Alarm{}, {});
    alarm.origin.ranges.clear();
    const auto codes = walk_.codes.find(at);
    if (codes != walk_.codes.end()) {
      for (const std::size_t code : codes->second)
        if (code != kNowhere) alarm.origin.ranges.push_back(flat_.steps[code].range);
    }
    out_.push_back({std::move(alarm), kNowhere, false});
  }

  // Where a jump to the step arrives in the end; in a circle of jumps somewhere in it.
  std::size_t arrival(std::size_t step) {
    std::vector<std::size_t> passed;
    std::size_t place = starts_[step];
    for (; place < out_.size() && arrivals_[place] == kNowhere; place = starts_[out_[place].target]) {
      if (!std::holds_alternative<ir::Jump>(out_[place].statement.node)) break;
      arrivals_[place] = place; // until it is known: where a circle ends
      passed.push_back(place);
    }
    if (place < out_.size() && arrivals_[place] != kNowhere) place = arrivals_[place];
    for (const std::size_t one : passed)
      arrivals_[one] = place;
    return place;
  }

  // The first statement from the place on that is still there.
  std::size_t present(std::size_t place) {
    std::size_t root = place;
    while (next_[root] != root)
      root = next_[root];
    while (next_[place] != root)
      place = std::exchange(next_[place], root);
    return root;
  }
  std::size_t after(std::size_t place) { return place < out_.size() ? present(place + 1) : place; }
  std::size_t goal(std::size_t place) { return present(starts_[out_[place].target]); }

  // What led there leads to the next one.
  void erase(std::size_t place) {
    next_[place] = place + 1;
    sources_[present(place)] += sources_[place];
  }

  void shortenAll() {
    next_.resize(out_.size() + 1);
    std::iota(next_.begin(), next_.end(), std::size_t{0});
    sources_.assign(out_.size() + 1, 0);
    for (const Emitted& each : out_)
      if (each.target != kNowhere) ++sources_[starts_[each.target]];
    while (shorten()) {
    }
    std::vector<std::size_t> places(out_.size() + 1);
    std::vector<Emitted> left;
    for (std::size_t i = 0; i <= out_.size(); ++i) {
      places[i] = left.size();
      if (i < out_.size() && next_[i] == i) left.push_back(std::move(out_[i]));
    }
    for (std::size_t& start : starts_)
      start = places[start];
    out_ = std::move(left);
    arrivals_.assign(out_.size(), kNowhere);
  }

  // One pass: jumps to the next statement go, branches around a jump are turned round. false: nothing found.
  bool shorten() {
    bool changed = false;
    for (std::size_t i = present(0); i < out_.size(); i = after(i)) {
      const std::size_t following = after(i);
      if (std::holds_alternative<ir::Jump>(out_[i].statement.node) && goal(i) == following) {
        --sources_[following];
        erase(i);
        changed = true;
        i = following;
        continue;
      }
      auto* branch = std::get_if<ir::Branch>(&out_[i].statement.node);
      if (branch == nullptr || following >= out_.size() ||
          !std::holds_alternative<ir::Jump>(out_[following].statement.node) || goal(i) != after(following) ||
          sources_[following] > 0)
        continue;
      --sources_[goal(i)];
      branch->condition = ir::negate(branch->condition);
      out_[i].target = out_[following].target;
      out_[i].statement.origin.ranges = mergedRanges(out_[i].statement, out_[following].statement);
      erase(following);
      changed = true;
    }
    return changed;
  }

  static std::vector<SourceRange> mergedRanges(const ir::CycleStatement& a, const ir::CycleStatement& b) {
    std::vector<SourceRange> ranges = a.origin.ranges;
    for (const SourceRange& range : b.origin.ranges)
      if (std::find(ranges.begin(), ranges.end(), range) == ranges.end()) ranges.push_back(range);
    return ranges;
  }

  std::vector<ir::CycleStatement> placed() {
    std::map<std::size_t, ir::LabelId> labels; // by place
    std::set<std::string> names;
    for (const ir::LabelName& label : cycle_.labels)
      names.insert(label.name);
    for (const Emitted& each : out_)
      if (each.target != kNowhere) labels.emplace(arrival(each.target), 0);
    int number = 0;
    for (auto& [place, id] : labels) {
      std::string name;
      do {
        name = fmt::format("L{}", ++number);
      } while (!names.insert(name).second);
      id = cycle_.addLabel({name, {}});
    }
    std::vector<ir::CycleStatement> list;
    for (std::size_t i = 0; i <= out_.size(); ++i) {
      if (const auto label = labels.find(i); label != labels.end())
        list.push_back(statementOf(ir::Label{label->second}, {}));
      if (i == out_.size()) break;
      Emitted& each = out_[i];
      if (auto* jump = std::get_if<ir::Jump>(&each.statement.node))
        jump->target = labels.at(arrival(each.target));
      if (auto* branch = std::get_if<ir::Branch>(&each.statement.node))
        branch->target = labels.at(arrival(each.target));
      list.push_back(each.statement);
    }
    return list;
  }

  const Flat& flat_;
  const WalkResult& walk_;
  const EmitOptions& options_;
  ir::Cycle& cycle_;
  std::vector<Emitted> out_;
  std::vector<std::size_t> starts_;   // of steps, in out_
  std::vector<std::size_t> next_;     // of out_: itself, or a later one where it is gone
  std::vector<std::size_t> sources_;  // of out_: how many jumps and branches lead there
  std::vector<std::size_t> arrivals_; // of jumps in out_, as far as they are known
};

} // namespace

ir::CycleStatement statementOf(decltype(ir::CycleStatement::node) node, SourceRange range,
                               std::string reason) {
  ir::CycleStatement statement;
  statement.node = std::move(node);
  if (range.hasPlace()) statement.origin.ranges = {range};
  statement.origin.reason = std::move(reason);
  return statement;
}

std::vector<ir::CycleStatement> emitStatements(const Flat& flat, const WalkResult& walk,
                                               const EmitOptions& options, ir::Cycle& cycle) {
  return Emitter(flat, walk, options, cycle).run();
}

std::size_t endlessStep(const Flat& flat, const WalkResult& walk, const std::set<std::size_t>& alarms) {
  const std::size_t size = flat.steps.size();
  std::vector<std::vector<std::size_t>> back(size);
  std::vector<std::size_t> open;
  std::vector<bool> leads(size, false);
  for (std::size_t at = 0; at < size; ++at) {
    if (!walk.reached[at]) continue;
    std::vector<std::size_t> next = followers(flat, at);
    if (std::holds_alternative<FlatBranch>(flat.steps[at].step)) {
      const std::size_t jump = next[1];
      const std::size_t fall = next[0];
      next.clear();
      if (walk.falls[at]) next.push_back(fall);
      if (walk.jumps[at]) next.push_back(jump);
    }
    if (alarms.contains(at)) next.clear();
    bool goesOn = false;
    for (const std::size_t to : next) {
      if (to >= size || !walk.reached[to]) continue;
      back[to].push_back(at);
      goesOn = true;
    }
    if (goesOn) continue;
    leads[at] = true;
    open.push_back(at);
  }
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::size_t from : back[at]) {
      if (leads[from]) continue;
      leads[from] = true;
      open.push_back(from);
    }
  }
  // The jump that closes the circle tells best.
  std::size_t found = kNowhere;
  for (std::size_t at = 0; at < size; ++at) {
    if (!walk.reached[at] || leads[at]) continue;
    const std::vector<std::size_t> next = followers(flat, at);
    if (!next.empty() && next.back() <= at) return at;
    if (found == kNowhere) found = at;
  }
  return found;
}

} // namespace dotek::frontend::gibbs
