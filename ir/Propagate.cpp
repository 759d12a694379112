#include "ir/Propagate.h"

#include "ir/Substitute.h"
#include "ir/Walk.h"

#include <deque>
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
                       Comment, OpaqueBlock> auto&) { return true; });
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
                     Coolant, SetMode, Dwell, Stop, Alarm, Comment> auto&) { return false; });
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
                       Dwell, Stop, Comment, OpaqueBlock> auto&) {});
  }
  return out;
}

std::optional<Unrolled> unroll(const std::vector<CycleStatement>& list, Environment entry,
                               std::uint32_t maxSteps) {
  const auto places = labelPlaces(list);
  Environment environment = std::move(entry);
  Unrolled out;
  std::size_t at = 0;
  for (std::uint32_t steps = 0; at < list.size(); ++steps) {
    if (steps >= maxSteps) return std::nullopt;
    const CycleStatement& statement = list[at++];
    enum class Then : std::uint8_t { Next, Jump, End, Alarm, Undecided };
    LabelId target = 0;
    const Then then = match(
        statement, [](const Label&) { return Then::Next; }, [](const Return&) { return Then::End; },
        [&](const Jump& node) {
          target = node.target;
          return Then::Jump;
        },
        [&](const Branch& node) {
          const auto taken = holds(*node.condition, environment);
          target = node.target;
          return !taken ? Then::Undecided : *taken ? Then::Jump : Then::Next;
        },
        [&](const Assign& node) {
          out.statements.push_back(specialisedStatement(statement, environment));
          assign(node, environment);
          return Then::Next;
        },
        [&](const Alarm&) {
          out.statements.push_back(specialisedStatement(statement, environment));
          return Then::Alarm;
        },
        [&](const OneOf<Store, Move, Measure, CallCycle, ProbePower, Spindle, Coolant, SetMode, Dwell, Stop,
                        Comment, OpaqueBlock> auto&) {
          out.statements.push_back(specialisedStatement(statement, environment));
          return Then::Next;
        });
    if (then == Then::End) break;
    if (then == Then::Alarm) return out;
    if (then == Then::Undecided) return std::nullopt;
    if (then == Then::Next) continue;
    const auto place = places.find(target);
    if (place == places.end()) return std::nullopt;
    at = place->second;
  }
  out.atEnd = std::move(environment);
  return out;
}

} // namespace dotek::ir
