#include "ir/Propagate.h"

#include "ir/Substitute.h"
#include "ir/Walk.h"

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <utility>

namespace dotek::ir {
namespace {

// Bounds of the analysis, in entries of environments: beyond them nothing that is assigned is known at a
// label.
constexpr std::size_t kMostEntries = 300'000;
constexpr std::size_t kMostWork = 20'000'000;

std::unordered_map<LabelId, std::size_t> labelPlaces(const std::vector<CycleStatement>& list) {
  std::unordered_map<LabelId, std::size_t> out;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (const auto* label = std::get_if<Label>(&list[i].node)) out.try_emplace(label->label, i);
  return out;
}

bool same(const Scalar& a, const Scalar& b) {
  return a.state == b.state && (!a.known() || a.value == b.value);
}

// What holds on both paths. Whether `into` changed.
bool meet(Environment& into, const Environment& other) {
  bool changed = false;
  for (std::size_t i = 0; i < into.size(); ++i) {
    if (into[i].state == Scalar::State::Unknown || same(into[i], other[i])) continue;
    into[i] = Scalar{};
    changed = true;
  }
  return changed;
}

void assign(const Assign& node, Environment& environment) {
  if (node.variable >= environment.size()) return;
  Scalar value = evaluate(*node.value, environment);
  if (value.state == Scalar::State::Failed) value = Scalar{};
  environment[node.variable] = value;
}

class Propagation {
public:
  Propagation(const std::vector<CycleStatement>& list, Environment entry)
      : list_(list), places_(labelPlaces(list)) {
    out_.entry = std::move(entry);
  }

  Constants run() {
    if (places_.size() * out_.entry.size() > kMostEntries) return cautious();
    walk(0, out_.entry);
    while (!open_.empty() && work_ <= kMostWork) {
      const std::size_t at = open_.front();
      open_.pop_front();
      waiting_.erase(at);
      walk(at + 1, out_.atLabel.at(at));
    }
    return work_ <= kMostWork ? std::move(out_) : cautious();
  }

private:
  void walk(std::size_t at, Environment environment) {
    for (; at < list_.size() && work_ <= kMostWork; ++at, ++work_)
      if (!step(at, environment)) return;
    reachEnd(environment);
  }

  // Whether the next statement follows.
  bool step(std::size_t at, Environment& environment) {
    return match(
        list_[at],
        [&](const Assign& node) {
          assign(node, environment);
          return true;
        },
        [&](const Label&) {
          reach(at, environment);
          return false;
        },
        [&](const Jump& node) {
          reachLabel(node.target, environment);
          return false;
        },
        [&](const Return&) {
          reachEnd(environment);
          return false;
        },
        [](const Alarm&) { return false; },
        [&](const Branch& node) {
          const auto taken = holds(*node.condition, environment);
          if (taken != false) reachLabel(node.target, environment);
          return taken != true;
        },
        [](const OneOf<Store, Move, Measure, CallCycle, ProbePower, Spindle, Coolant, SetMode, Dwell, Stop,
                       Comment, OpaqueBlock, Port, Print> auto&) { return true; });
  }

  void reachLabel(LabelId label, const Environment& environment) {
    const auto place = places_.find(label);
    if (place != places_.end()) reach(place->second, environment);
  }

  void reach(std::size_t at, const Environment& environment) {
    work_ += environment.size();
    const auto [entry, fresh] = out_.atLabel.try_emplace(at, environment);
    if ((fresh || meet(entry->second, environment)) && waiting_.insert(at).second) open_.push_back(at);
  }

  void reachEnd(const Environment& environment) {
    if (out_.atEnd)
      meet(*out_.atEnd, environment);
    else
      out_.atEnd = environment;
  }

  // Every label is reached, with nothing known of what the list assigns: one environment for all.
  Constants cautious() {
    Environment rest = out_.entry;
    for (const CycleStatement& statement : list_) {
      const auto* set = std::get_if<Assign>(&statement.node);
      if (set && set->variable < rest.size()) rest[set->variable] = Scalar{};
    }
    Constants out;
    out.entry = std::move(out_.entry);
    out.atEnd = rest;
    out.atOthers = std::move(rest);
    return out;
  }

  const std::vector<CycleStatement>& list_;
  std::unordered_map<LabelId, std::size_t> places_;
  Constants out_;
  std::deque<std::size_t> open_; // labels whose statements are to be walked (again)
  std::set<std::size_t> waiting_;
  std::size_t work_ = 0;
};

CycleStatement specialisedStatement(const CycleStatement& statement, const Environment& environment) {
  CycleStatement out = statement;
  const bool takesNull = match(
      out, [](const OneOf<Assign, OpaqueBlock> auto&) { return true; },
      [](const OneOf<Store, Label, Jump, Branch, Return, Move, Measure, CallCycle, ProbePower, Spindle,
                     Coolant, SetMode, Dwell, Stop, Alarm, Comment, Port, Print> auto&) { return false; });
  eachSlot(out, [&](ExpressionPtr& slot) {
    ExpressionPtr value = substitute(slot, environment);
    if (takesNull || !std::holds_alternative<NullValue>(value->node)) slot = std::move(value);
  });
  return out;
}

} // namespace

Constants propagate(const std::vector<CycleStatement>& list, Environment entry) {
  return Propagation(list, std::move(entry)).run();
}

std::vector<CycleStatement> specialised(const std::vector<CycleStatement>& list, const Constants& constants) {
  std::vector<CycleStatement> out;
  Environment environment = constants.entry;
  bool reached = true;
  bool inRest = false;              // `environment` began as atOthers
  std::vector<VariableId> assigned; // since the last label
  for (std::size_t i = 0; i < list.size(); ++i) {
    const CycleStatement& statement = list[i];
    if (std::holds_alternative<Label>(statement.node)) {
      const auto entry = constants.atLabel.find(i);
      reached = constants.atOthers || entry != constants.atLabel.end();
      if (constants.atOthers) {
        // Copying the whole each time would cost labels times variables.
        if (!inRest) environment = *constants.atOthers;
        for (const VariableId id : assigned)
          environment[id] = (*constants.atOthers)[id];
        inRest = true;
      } else if (reached) {
        environment = entry->second;
      }
      assigned.clear();
    }
    if (!reached) continue;
    if (const auto* branch = std::get_if<Branch>(&statement.node)) {
      ConditionPtr condition = substitute(branch->condition, environment);
      const auto* known = std::get_if<Truth>(&condition->node);
      if (known && !known->value) continue;
      CycleStatement next;
      next.origin = statement.origin;
      if (known)
        next.node = Jump{branch->target};
      else
        next.node = Branch{std::move(condition), branch->target};
      out.push_back(std::move(next));
      if (known) reached = false;
      continue;
    }
    out.push_back(specialisedStatement(statement, environment));
    match(
        statement,
        [&](const Assign& node) {
          assign(node, environment);
          if (node.variable < environment.size()) assigned.push_back(node.variable);
        },
        [&](const OneOf<Jump, Return, Alarm> auto&) { reached = false; },
        [](const OneOf<Store, Label, Branch, Move, Measure, CallCycle, ProbePower, Spindle, Coolant, SetMode,
                       Dwell, Stop, Comment, OpaqueBlock, Port, Print> auto&) {});
  }
  return out;
}

namespace {

class Unrolling {
public:
  Unrolling(const std::vector<CycleStatement>& list, Environment entry, std::uint32_t maxSteps,
            const std::function<LabelId(LabelId)>& newLabel)
      : list_(list), places_(labelPlaces(list)), now_(std::move(entry)), steps_(maxSteps),
        newLabel_(newLabel) {
    for (std::size_t at = 0; at < list.size(); ++at)
      if (const auto to = placeOf(targetOf(list[at])); to && *to <= at) {
        std::size_t& first = firstBack_.try_emplace(at, *to).first->second;
        first = std::min(first, *to);
      }
    // From here on: the first statement that something after a place goes back to.
    std::size_t least = list.size();
    for (auto at = firstBack_.rbegin(); at != firstBack_.rend(); ++at)
      at->second = least = std::min(least, at->second);
  }

  std::optional<Unrolled> run() {
    while (good_ && next())
      good_ = good_ && steps_-- > 0;
    if (!good_) return std::nullopt;
    if (now_) ends(*now_);
    return std::move(out_);
  }

private:
  struct Waiting {
    LabelId label = 0;
    Environment environment;
  };

  static std::optional<LabelId> targetOf(const CycleStatement& statement) {
    if (const auto* jump = std::get_if<Jump>(&statement.node)) return jump->target;
    if (const auto* branch = std::get_if<Branch>(&statement.node)) return branch->target;
    return std::nullopt;
  }
  std::optional<std::size_t> placeOf(std::optional<LabelId> label) const {
    const auto found = label ? places_.find(*label) : places_.end();
    return found == places_.end() ? std::nullopt : std::optional(found->second);
  }

  void ends(const Environment& environment) {
    if (out_.atEnd)
      meet(*out_.atEnd, environment);
    else
      out_.atEnd = environment;
  }

  void emit(const CycleStatement& like, decltype(CycleStatement::node) node) {
    CycleStatement out;
    out.origin = like.origin;
    out.node = std::move(node);
    out_.statements.push_back(std::move(out));
  }

  // The label that stands for the place from now on.
  LabelId wait(std::size_t place) {
    const auto [at, isNew] = waiting_.try_emplace(place);
    if (isNew)
      at->second = Waiting{newLabel_(std::get<Label>(list_[place].node).label), *now_};
    else
      meet(at->second.environment, *now_);
    return at->second.label;
  }

  void jump(const CycleStatement& statement, std::size_t to) {
    if (to < at_) {
      // What waits is after the loop, or two ways would go through the next round.
      for (const auto& [place, waits] : waiting_) {
        const auto back = firstBack_.lower_bound(place);
        good_ = good_ && (back == firstBack_.end() || back->second > at_);
      }
      at_ = to;
    } else if (waiting_.empty() || waiting_.begin()->first >= to) {
      at_ = to;
    } else {
      const LabelId label = wait(to);
      emit(statement, Jump{label});
      now_.reset();
    }
  }

  // Whether there is more.
  bool next() {
    if (!now_) {
      if (waiting_.empty()) return false;
      at_ = waiting_.begin()->first;
    }
    if (at_ >= list_.size()) return false;
    if (const auto lands = waiting_.find(at_); lands != waiting_.end()) {
      emit(list_[at_], Label{lands->second.label});
      if (now_)
        meet(*now_, lands->second.environment);
      else
        now_ = std::move(lands->second.environment);
      waiting_.erase(lands);
    }
    const CycleStatement& statement = list_[at_++];
    match(
        statement, [](const Label&) {},
        [&](const Return&) {
          ends(*now_);
          if (!waiting_.empty()) emit(statement, Return{});
          now_.reset();
        },
        [&](const Jump& node) { goTo(statement, placeOf(node.target)); },
        [&](const Branch& node) {
          const auto taken = holds(*node.condition, *now_);
          const auto to = placeOf(node.target);
          if (taken == true) return goTo(statement, to);
          if (taken == false) return;
          good_ = good_ && to && *to >= at_;
          if (!good_) return;
          ConditionPtr condition = substitute(node.condition, *now_);
          emit(statement, Branch{std::move(condition), wait(*to)});
        },
        [&](const Assign& node) {
          out_.statements.push_back(specialisedStatement(statement, *now_));
          assign(node, *now_);
        },
        [&](const Alarm&) {
          out_.statements.push_back(specialisedStatement(statement, *now_));
          now_.reset();
        },
        [&](const OneOf<Store, Move, Measure, CallCycle, ProbePower, Spindle, Coolant, SetMode, Dwell, Stop,
                        Comment, OpaqueBlock, Port, Print> auto&) {
          out_.statements.push_back(specialisedStatement(statement, *now_));
        });
    return true;
  }

  void goTo(const CycleStatement& statement, std::optional<std::size_t> to) {
    if (to)
      jump(statement, *to);
    else
      good_ = false;
  }

  const std::vector<CycleStatement>& list_;
  std::unordered_map<LabelId, std::size_t> places_;
  std::map<std::size_t, std::size_t> firstBack_; // by the place of a jump back, see the constructor
  std::optional<Environment> now_;               // nothing: no way comes here
  std::uint32_t steps_;
  const std::function<LabelId(LabelId)>& newLabel_;
  std::map<std::size_t, Waiting> waiting_; // branches that have not landed, by the place of their label
  std::size_t at_ = 0;
  bool good_ = true;
  Unrolled out_;
};

} // namespace

std::optional<Unrolled> unroll(const std::vector<CycleStatement>& list, Environment entry,
                               std::uint32_t maxSteps, const std::function<LabelId(LabelId)>& newLabel) {
  return Unrolling(list, std::move(entry), maxSteps, newLabel).run();
}

} // namespace dotek::ir
