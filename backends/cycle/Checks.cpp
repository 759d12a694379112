// The checks of the source as conditions that have to hold: a flat list with jumps, flags and alarms becomes
// a list of decisions, of which the first that is met counts.
#include "backends/cycle/State.h"
#include "ir/Evaluate.h"
#include "ir/Fold.h"
#include "ir/Match.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::backends::cycle {

namespace {

constexpr std::size_t kMostSteps = 20'000; // over all paths
constexpr std::size_t kMostDecisions = 400;
constexpr double kFirstSystem = 54, kLastSystem = 59;

// A local while the checks run: a value, and before it the values that it has where a condition holds, the
// first that does. A null pointer: nothing was assigned.
struct Value {
  std::vector<std::pair<ir::ConditionPtr, ir::ExpressionPtr>> where;
  ir::ExpressionPtr otherwise;
};
using Locals = std::map<ir::VariableId, Value>;

// What becomes of the values that get here: an alarm, or the body (a null pointer). The last of a list has no
// condition.
struct Decision {
  ir::ConditionPtr when;
  const ir::CycleStatement* alarm = nullptr;
};
using Decisions = std::vector<Decision>;

ir::ConditionPtr both(const ir::ConditionPtr& a, const ir::ConditionPtr& b) {
  if (a == nullptr || b == nullptr) return a == nullptr ? b : a;
  return ir::join(ir::Connective::And, a, b);
}

class Reader {
public:
  explicit Reader(State& state) : state_(state), list_(state.cycle.checks) {
    for (std::size_t i = 0; i < list_.size(); ++i)
      if (const auto* label = std::get_if<ir::Label>(&list_[i].node)) places_[label->label] = i;
  }

  std::optional<Checked> read() {
    std::optional<Decisions> decisions = run(0, {});
    if (!decisions) return std::nullopt;
    Checked out;
    ir::ConditionPtr passes; // one of the decisions before lets the values pass
    for (const Decision& one : *decisions) {
      if (one.alarm == nullptr) {
        if (one.when == nullptr) break;
        passes = passes == nullptr ? one.when : ir::join(ir::Connective::Or, passes, one.when);
        continue;
      }
      if (one.when == nullptr && passes != nullptr) {
        add(out.requirements, {passes, one.alarm, placeOf(passes)});
        break;
      }
      if (one.when == nullptr) {
        state_.refuse(one.alarm->origin.range(), "a check that rejects all values",
                      "mend the check: no call of the cycle would run");
        return std::nullopt;
      }
      ir::ConditionPtr holds = ir::negate(one.when);
      if (passes != nullptr) holds = ir::join(ir::Connective::Or, passes, holds);
      add(out.requirements, {std::move(holds), one.alarm, placeOf(one.when)});
    }
    for (Requirement& one : out.requirements)
      one.condition = ir::simplify(withinType(one.condition));
    std::erase_if(out.requirements, [](const Requirement& one) {
      const auto* truth = std::get_if<ir::Truth>(&one.condition->node);
      return truth != nullptr && truth->value;
    });
    if (ended_)
      for (auto& [id, value] : *ended_)
        if (value.where.empty() && value.otherwise != nullptr) out.locals.emplace(id, value.otherwise);
    return out;
  }

private:
  std::nullopt_t give(SourceRange range, const std::string& what) {
    state_.refuse(range, what,
                  "the checks become `require` lines: write them as comparisons, each with its message");
    return std::nullopt;
  }

  static std::string textOf(const Requirement& one) { return std::get<ir::Alarm>(one.alarm->node).message; }

  SourceRange placeOf(const ir::ConditionPtr& condition) {
    if (condition->range.hasPlace()) return condition->range;
    SourceRange out;
    ir::eachNode(condition, [&](const ir::Expression& node) {
      if (!out.hasPlace()) out = node.range;
    });
    return out;
  }

  // Neighbours with one message are one condition, in the order of the source.
  void add(std::vector<Requirement>& list, Requirement next) {
    if (list.empty() || textOf(list.back()) != textOf(next)) {
      list.push_back(std::move(next));
      return;
    }
    Requirement& last = list.back();
    const bool before = next.range.hasPlace() && last.range.hasPlace() &&
                        next.range.file == last.range.file && next.range.begin < last.range.begin;
    last.condition = before ? ir::join(ir::Connective::And, next.condition, last.condition)
                            : ir::join(ir::Connective::And, last.condition, next.condition);
    if (before) last.range = next.range;
  }

  // ---- the checks, path by path

  // The local whose value depends on where the path came from, of those that the condition or value reads.
  template <class Tree> std::optional<ir::VariableId> divided(const Tree& tree, const Locals& locals) const {
    std::optional<ir::VariableId> out;
    ir::eachNode(tree, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::VariableUse>(&node.node);
      const auto local = use == nullptr ? locals.end() : locals.find(use->variable);
      if (!out && local != locals.end() && !local->second.where.empty()) out = use->variable;
    });
    return out;
  }

  template <class Tree> Tree with(const Tree& tree, const Locals& locals) const {
    return ir::rewrite(tree, [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
      const auto* use = std::get_if<ir::VariableUse>(&node->node);
      const auto local = use == nullptr ? locals.end() : locals.find(use->variable);
      return local == locals.end() || local->second.otherwise == nullptr ? node : local->second.otherwise;
    });
  }

  // The statement again for each value of the local.
  std::optional<Decisions> forEach(ir::VariableId id, std::size_t at, const Locals& locals) {
    const Value value = locals.at(id);
    Decisions out;
    Locals own = locals;
    for (const auto& [when, what] : value.where) {
      own[id] = {{}, what};
      const std::optional<Decisions> rest = run(at, own);
      if (!rest || !append(out, when, *rest)) return std::nullopt;
    }
    own[id] = {{}, value.otherwise};
    const std::optional<Decisions> rest = run(at, own);
    if (!rest || !append(out, nullptr, *rest)) return std::nullopt;
    return out;
  }

  bool append(Decisions& out, const ir::ConditionPtr& when, const Decisions& rest) {
    const bool single = std::all_of(rest.begin(), rest.end(),
                                    [&](const Decision& one) { return one.alarm == rest.front().alarm; });
    if (single)
      out.push_back({when, rest.front().alarm});
    else
      for (const Decision& one : rest)
        out.push_back({both(when, one.when), one.alarm});
    return out.size() <= kMostDecisions;
  }

  // Assignments of constants alone, between `from` and the label at `to`.
  bool setsFlags(std::size_t from, std::size_t to, const Locals& locals) const {
    bool any = false;
    for (std::size_t i = from; i < to; ++i) {
      const bool good = ir::match(
          list_[i],
          [&](const ir::Assign& node) {
            const auto known = locals.find(node.variable);
            any = true;
            return ir::constantValue(node.value) != nullptr && known != locals.end() &&
                   known->second.otherwise != nullptr;
          },
          [](const ir::OneOf<ir::Label, ir::Comment> auto&) { return true; },
          [](const ir::OneOf<ir::Jump, ir::Branch, ir::Store, ir::Move, ir::Measure, ir::CallCycle,
                             ir::ProbePower, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                             ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {
            return false;
          });
      if (!good) return false;
    }
    return any;
  }

  // What one statement comes to.
  struct Step {
    bool failed = false;
    std::optional<Decisions> ends = {}; // the path ends here
    std::size_t next = 0;               // else it goes on there
  };

  Step assign(const ir::Assign& node, std::size_t at, Locals& locals) {
    if (const auto id = divided(node.value, locals)) return ended(forEach(*id, at, locals));
    locals[node.variable] = {{}, with(node.value, locals)};
    return {.next = at + 1};
  }

  Step ended(std::optional<Decisions> decisions) {
    if (!decisions) return {.failed = true};
    return {.ends = std::move(decisions)};
  }

  Step refused(SourceRange range, const std::string& what) {
    give(range, what);
    return {.failed = true};
  }

  Step branch(const ir::Branch& node, SourceRange range, std::size_t at, Locals& locals) {
    if (const auto id = divided(node.condition, locals)) return ended(forEach(*id, at, locals));
    const ir::ConditionPtr condition = ir::simplify(with(node.condition, locals));
    const std::size_t to = places_.at(node.target);
    if (to <= at) return refused(range, "a loop in the checks");
    if (const auto* truth = std::get_if<ir::Truth>(&condition->node))
      return {.next = truth->value ? to : at + 1};
    if (setsFlags(at + 1, to, locals)) {
      for (std::size_t i = at + 1; i < to; ++i)
        if (const auto* flag = std::get_if<ir::Assign>(&list_[i].node)) {
          auto& where = locals[flag->variable].where;
          where.insert(where.begin(), {ir::negate(condition), flag->value});
        }
      return {.next = to};
    }
    const std::optional<Decisions> taken = run(to, locals);
    const std::optional<Decisions> rest = taken ? run(at + 1, locals) : std::nullopt;
    if (!rest) return {.failed = true};
    // An alarm first, then one decision, so that what follows needs no condition of its own.
    const bool restFirst = rest->size() == 1 && (rest->front().alarm != nullptr || taken->size() > 1);
    Decisions out;
    const bool good = restFirst ? append(out, ir::negate(condition), *rest) && append(out, nullptr, *taken)
                                : append(out, condition, *taken) && append(out, nullptr, *rest);
    if (!good) return refused(range, "a tangle of checks");
    return ended(std::move(out));
  }

  // By value: each path has its own locals.
  std::optional<Decisions> run(std::size_t at, Locals locals) {
    while (at < list_.size()) {
      const ir::CycleStatement& statement = list_[at];
      const SourceRange range = statement.origin.range();
      if (++steps_ > kMostSteps) return give(range, "a tangle of checks");
      Step step = ir::match(
          statement, [&](const ir::Assign& node) { return assign(node, at, locals); },
          [&](const ir::Jump& node) {
            const std::size_t to = places_.at(node.target);
            return to <= at ? refused(range, "a loop in the checks") : Step{.next = to};
          },
          [&](const ir::Branch& node) { return branch(node, range, at, locals); },
          [&](const ir::Alarm&) {
            return ended(Decisions{{nullptr, &statement}});
          },
          [&](const ir::Return&) { return Step{.next = list_.size()}; },
          [&](const ir::OneOf<ir::Label, ir::Comment> auto&) { return Step{.next = at + 1}; },
          [&](const ir::OneOf<ir::Store, ir::Move, ir::Measure, ir::CallCycle, ir::ProbePower, ir::Spindle,
                              ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::OpaqueBlock, ir::Port,
                              ir::Print> auto&) {
            return refused(range, "a statement of the checks that does something");
          });
      if (step.failed) return std::nullopt;
      if (step.ends) return std::move(step.ends);
      at = step.next;
    }
    if (const auto several = end(locals))
      return give(assignedAt(*several), "a value that the checks compute in several ways");
    return Decisions{{nullptr, nullptr}};
  }

  // Locals that the body reads are the same on all paths; else one that is not.
  std::optional<ir::VariableId> end(const Locals& locals) {
    if (!ended_) {
      ended_ = locals;
      for (const ir::CycleStatement& statement : state_.cycle.body)
        ir::eachNode(statement, [&](const ir::Expression& node) {
          if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) readByBody_.insert(use->variable);
        });
    }
    const auto found = std::find_if_not(readByBody_.begin(), readByBody_.end(), [&](ir::VariableId id) {
      const Locals& first = *ended_;
      const auto one = first.find(id), other = locals.find(id);
      if (one == ended_->end() || other == locals.end()) return one == ended_->end() && other == locals.end();
      return one->second.where.empty() && other->second.where.empty() &&
             ir::equal(one->second.otherwise, other->second.otherwise);
    });
    return found == readByBody_.end() ? std::nullopt : std::optional(*found);
  }

  // Where the checks give the variable its value.
  SourceRange assignedAt(ir::VariableId id) const {
    SourceRange out = state_.cycle.range;
    for (const ir::CycleStatement& statement : list_)
      if (const auto* set = std::get_if<ir::Assign>(&statement.node);
          set && set->variable == id && statement.origin.range().hasPlace())
        out = statement.origin.range();
    return out;
  }

  // ---- what the type of a work offset says anyway

  ir::ConditionPtr withinType(const ir::ConditionPtr& condition) {
    std::set<ir::VariableId> read;
    ir::eachNode(condition, [&](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) read.insert(use->variable);
    });
    if (read.size() == 1)
      if (const auto names = state_.choices.find(*read.begin()); names != state_.choices.end()) {
        for (std::size_t place = 1; place <= names->second.size(); ++place) {
          ir::Environment environment(state_.cycle.variables.size());
          environment[*read.begin()] = ir::Scalar::of(static_cast<double>(place));
          if (ir::holds(*condition, environment) != true) return condition;
        }
        return ir::truth(true); // it is one of them
      }
    const bool alone = read.size() == 1 && state_.cycle.variable(*read.begin()).kind == ir::Kind::WorkOffset;
    if (!alone) {
      const auto* junction = std::get_if<ir::Junction>(&condition->node);
      if (junction == nullptr) return condition;
      return ir::join(junction->op, withinType(junction->left), withinType(junction->right),
                      condition->range);
    }
    const ir::VariableId id = *read.begin();
    const auto shift = state_.shifts.find(id);
    const double by = shift == state_.shifts.end() ? 0 : shift->second;
    ir::ConditionPtr some;
    std::size_t good = 0;
    for (double system = kFirstSystem; system <= kLastSystem; ++system) {
      ir::Environment environment(state_.cycle.variables.size());
      environment[id] = ir::Scalar::of(system - by);
      const auto holds = ir::holds(*condition, environment);
      if (!holds) return condition;
      if (!*holds) continue;
      ++good;
      const ir::ConditionPtr is = ir::compare(ir::Relation::Equal, ir::variable(id), ir::constant(system));
      some = some == nullptr ? is : ir::join(ir::Connective::Or, some, is);
    }
    if (some == nullptr) return ir::truth(false);
    if (good < static_cast<std::size_t>(kLastSystem - kFirstSystem) + 1) return some;
    state_.note(placeOf(condition), "a check that the work offset is one of G54 to G59",
                "a parameter of the type `work_offset` is nothing else");
    return ir::truth(true);
  }

  State& state_;
  const std::vector<ir::CycleStatement>& list_;
  std::unordered_map<ir::LabelId, std::size_t> places_;
  std::size_t steps_ = 0;
  std::optional<Locals> ended_;
  std::set<ir::VariableId> readByBody_;
};

} // namespace

std::optional<Checked> readChecks(State& state) {
  return Reader(state).read();
}

} // namespace dotek::backends::cycle
