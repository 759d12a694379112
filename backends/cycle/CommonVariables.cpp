// #150=.. and the reads of it: each value that is kept there gets a name of its own.
#include "backends/cycle/Idioms.h"
#include "backends/cycle/Jumps.h"
#include "ir/Match.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace dotek::backends::cycle {

namespace {

constexpr std::uint32_t kFirst = 1, kLast = 999; // locals and common variables of Macro B
constexpr std::size_t kUnset = 0;                // "statement" that sets what nothing in the cycle has set

using Setters = std::set<std::size_t>; // statements by their place, from 1
using Reaching = std::map<std::uint32_t, Setters>;

std::optional<std::uint32_t> commonNumber(const ir::ExpressionPtr& number) {
  const double* value = ir::constantValue(number);
  if (value == nullptr || *value < kFirst || *value > kLast || *value != std::floor(*value))
    return std::nullopt;
  return static_cast<std::uint32_t>(*value);
}

class CommonVariables {
public:
  explicit CommonVariables(State& state) : state_(state), list_(state.cycle.body) {}

  void run() {
    follow();
    choose();
    if (names_.empty()) return;
    rewriteAll();
    alias();
  }

private:
  std::optional<std::uint32_t> stored(std::size_t at) const {
    const auto* store = std::get_if<ir::Store>(&list_[at].node);
    return store == nullptr ? std::nullopt : commonNumber(store->number);
  }

  static void merge(Reaching& into, const Reaching& other) {
    for (auto& [number, setters] : into)
      if (!other.contains(number)) setters.insert(kUnset);
    for (const auto& [number, setters] : other) {
      const bool fresh = !into.contains(number);
      Setters& own = into[number];
      own.insert(setters.begin(), setters.end());
      if (fresh) own.insert(kUnset);
    }
  }

  // Which values each read may see.
  void follow() {
    parent_.resize(list_.size() + 1);
    std::iota(parent_.begin(), parent_.end(), 0U);
    // What a jump brings back counts where the loop begins, so that is gone through until nothing is new.
    std::map<ir::LabelId, Reaching> arriving;
    for (std::map<ir::LabelId, Reaching> before = {{0, {}}}; before != arriving;) {
      before = arriving;
      pass(arriving);
    }
  }

  void pass(std::map<ir::LabelId, Reaching>& arriving) {
    std::optional<Reaching> now = Reaching();
    setters_.clear();
    const auto jump = [&](ir::LabelId target) {
      if (!now) return;
      const auto known = arriving.find(target);
      if (known == arriving.end())
        arriving.emplace(target, *now);
      else
        merge(known->second, *now);
    };
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (const auto* label = std::get_if<ir::Label>(&list_[i].node)) {
        const auto other = arriving.find(label->label);
        if (other == arriving.end()) continue;
        if (now)
          merge(*now, other->second);
        else
          now = other->second;
        continue;
      }
      if (!now) continue;
      reads(i, *now);
      if (const auto number = stored(i)) {
        (*now)[*number] = {i + 1};
        setters_[*number].push_back(i);
      }
      ir::match(
          list_[i], [&](const ir::Branch& node) { jump(node.target); },
          [&](const ir::Jump& node) {
            jump(node.target);
            now.reset();
          },
          [&](const ir::Return&) {
            atEnd(*now, left_);
            now.reset();
          },
          [&](const ir::Alarm&) {
            atEnd(*now, leftAtAlarm_); // the operator sees it
            now.reset();
          },
          [](const ir::OneOf<ir::Label, ir::Store, ir::Move, ir::Measure, ir::CallCycle, ir::ProbePower,
                             ir::Comment, ir::Assign, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                             ir::Stop, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {});
    }
    if (now) atEnd(*now, left_);
  }

  void atEnd(const Reaching& now, Setters& left) {
    for (const auto& [number, setters] : now) {
      left.insert(setters.begin(), setters.end());
      for (const std::size_t one : setters)
        join(one, *setters.rbegin()); // one value, whichever way led here
    }
  }

  void reads(std::size_t at, const Reaching& now) {
    ir::eachNode(list_[at], [&](const ir::Expression& node) {
      const auto* read = std::get_if<ir::MachineVariable>(&node.node);
      const auto number = read == nullptr ? std::nullopt : commonNumber(read->number);
      if (!number) return;
      const auto found = now.find(*number);
      if (found == now.end()) {
        unset_.insert(*number);
        return;
      }
      if (found->second.contains(kUnset)) unset_.insert(*number);
      const std::size_t first = *found->second.rbegin();
      for (const std::size_t one : found->second)
        join(one, first);
      read_.insert(first);
      readsAt_[{at, *number}] = first;
    });
  }

  std::size_t root(std::size_t one) {
    while (parent_[one] != one)
      one = parent_[one] = parent_[parent_[one]];
    return one;
  }
  void join(std::size_t a, std::size_t b) {
    if (a != kUnset && b != kUnset) parent_[root(a)] = root(b);
  }

  // A name for each value that is read.
  void choose() {
    const Setters seen = std::exchange(read_, {});
    for (const std::size_t one : seen)
      read_.insert(root(one));
    // What an alarm leaves is a result where the end leaves one there; else it is a value on its way.
    for (const auto& [number, setters] : setters_)
      if (std::any_of(setters.begin(), setters.end(), [&](std::size_t at) {
            return left_.contains(at + 1) && !read_.contains(root(at + 1));
          }))
        for (const std::size_t at : setters)
          if (leftAtAlarm_.contains(at + 1)) left_.insert(at + 1);
    for (const auto& [number, setters] : setters_) {
      if (unset_.contains(number)) continue; // the caller has set it: refused where it is read
      for (const std::size_t at : setters) {
        if (!read_.contains(root(at + 1))) continue;
        const auto known = names_.find(root(at + 1));
        if (known != names_.end()) continue;
        ir::Variable made;
        made.name = nameOf(root(at + 1), std::get<ir::Store>(list_[at].node).value, number);
        made.role = ir::Role::Local;
        made.range = list_[at].origin.range();
        names_.emplace(root(at + 1), state_.cycle.add(std::move(made)));
        if (left_.contains(at + 1))
          state_.note(made.range, fmt::format("#{} as a value for later", number),
                      "the cycle reads it itself, so it is a name of its own; make a `result` of it where "
                      "something reads it after the end");
      }
    }
  }

  // What the value is, as far as its terms show it.
  std::string nameOf(std::size_t of, const ir::ExpressionPtr& value, std::uint32_t number) {
    for (const std::size_t at : setters_[number]) { // `#1=#1+..` counts, or adds up
      const auto* sum = std::get_if<ir::Binary>(&std::get<ir::Store>(list_[at].node).value->node);
      if (root(at + 1) != of || sum == nullptr || sum->op != ir::BinaryOp::Add) continue;
      const auto* same = std::get_if<ir::MachineVariable>(&bare(sum->left).node);
      if (same == nullptr || commonNumber(same->number) != number) continue;
      return ir::constantValue(sum->right) != nullptr ? "counter" : "sum";
    }
    const auto* binary = std::get_if<ir::Binary>(&value->node);
    const double* by = binary == nullptr ? nullptr : ir::constantValue(binary->right);
    if (binary != nullptr && binary->op == ir::BinaryOp::Divide && by != nullptr && *by == 2) {
      const auto* sum = std::get_if<ir::Binary>(&binary->left->node);
      if (sum != nullptr && sum->op == ir::BinaryOp::Add) return "middle";
    }
    if (const auto* unary = std::get_if<ir::Unary>(&value->node))
      if (unary->op == ir::UnaryOp::ArcTangent || unary->op == ir::UnaryOp::ArcSine ||
          unary->op == ir::UnaryOp::ArcCosine)
        return "angle";
    if (binary != nullptr && binary->op == ir::BinaryOp::Direction) return "angle";
    return fmt::format("value_{}", number);
  }

  void rewriteAll() {
    for (std::size_t i = 0; i < list_.size(); ++i) {
      ir::rewrite(list_[i], [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
        const auto* read = std::get_if<ir::MachineVariable>(&node->node);
        const auto number = read == nullptr ? std::nullopt : commonNumber(read->number);
        const auto from = number ? readsAt_.find({i, *number}) : readsAt_.end();
        if (from == readsAt_.end()) return node;
        const auto name = names_.find(root(from->second));
        return name == names_.end() ? node : ir::variable(name->second, node->range);
      });
      const auto* store = std::get_if<ir::Store>(&list_[i].node);
      const auto name = store == nullptr || !stored(i) ? names_.end() : names_.find(root(i + 1));
      if (name != names_.end()) list_[i].node = ir::Assign{name->second, store->value};
    }
    // What another value takes the place of before anybody reads it.
    std::vector<ir::CycleStatement> kept;
    for (std::size_t i = 0; i < list_.size(); ++i)
      if (!stored(i) || left_.contains(i + 1) || read_.contains(root(i + 1)))
        kept.push_back(std::move(list_[i]));
    list_ = std::move(kept);
  }

  // A name that only repeats another one is left away.
  void alias() {
    std::map<ir::VariableId, std::size_t> sets;
    for (const ir::CycleStatement& one : list_)
      if (const auto* set = std::get_if<ir::Assign>(&one.node)) ++sets[set->variable];
    std::set<ir::VariableId> made;
    for (const auto& [at, id] : names_)
      made.insert(id);
    std::map<ir::VariableId, ir::ExpressionPtr> same;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      auto* set = std::get_if<ir::Assign>(&list_[i].node);
      if (set == nullptr || !made.contains(set->variable) || sets[set->variable] != 1) continue;
      const ir::Expression& value = bare(set->value);
      if (std::holds_alternative<ir::MeasuredResult>(value.node)) {
        state_.aliases.insert(set->variable); // the name of the touch says it, where there is one
        continue;
      }
      const auto* use = std::get_if<ir::VariableUse>(&value.node);
      if (use == nullptr || sets[use->variable] > 1) continue;
      const auto known = same.find(use->variable);
      const ir::ExpressionPtr other = known != same.end() ? known->second : ir::variable(use->variable);
      const ir::VariableId source = std::get<ir::VariableUse>(other->node).variable;
      if (state_.cycle.variable(source).role == ir::Role::Host && !staysUntilLast(set->variable, source, i))
        continue;
      same.emplace(set->variable, other);
    }
    for (ir::CycleStatement& one : list_)
      ir::rewrite(one, [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
        const auto* use = std::get_if<ir::VariableUse>(&node->node);
        const auto other = use == nullptr ? same.end() : same.find(use->variable);
        return other == same.end() ? node : other->second;
      });
    std::erase_if(list_, [&](const ir::CycleStatement& one) {
      const auto* set = std::get_if<ir::Assign>(&one.node);
      return set != nullptr && same.contains(set->variable);
    });
  }

  // `start.x` has other coordinates after its axis has been set, and `here.x` after a move: a number keeps.
  bool staysUntilLast(ir::VariableId id, ir::VariableId host, std::size_t from) const {
    const std::string& name = state_.cycle.variable(host).name;
    if (name.starts_with("here_")) return false;
    if (!name.starts_with("start_")) return true;
    const auto sets = [](const ir::CycleStatement& one) {
      const auto* call = std::get_if<ir::CallCycle>(&one.node);
      const auto* measure = std::get_if<ir::Measure>(&one.node);
      return (call != nullptr && call->setting) || (measure != nullptr && measure->setting);
    };
    // A loop may set it in a run before.
    bool set = !loopLabels(list_).empty() && std::any_of(list_.begin(), list_.end(), sets);
    for (std::size_t i = from + 1; i < list_.size(); ++i) {
      bool reads = false;
      ir::eachNode(list_[i], [&](const ir::Expression& node) {
        const auto* use = std::get_if<ir::VariableUse>(&node.node);
        reads = reads || (use != nullptr && use->variable == id);
      });
      if (reads && set) return false;
      set = set || sets(list_[i]);
    }
    return true;
  }

  State& state_;
  std::vector<ir::CycleStatement>& list_;
  std::map<std::uint32_t, std::vector<std::size_t>> setters_; // statements, from 0
  std::set<std::uint32_t> unset_;                             // read before the cycle sets them
  Setters left_;                                              // that reach the end
  Setters leftAtAlarm_;
  std::set<std::size_t> read_;
  std::map<std::pair<std::size_t, std::uint32_t>, std::size_t> readsAt_; // statement and number: a setter
  std::vector<std::size_t> parent_;                                      // setters of one value
  std::map<std::size_t, ir::VariableId> names_;                          // by the root of the setters
};

} // namespace

void nameCommonVariables(State& state) {
  CommonVariables(state).run();
}

} // namespace dotek::backends::cycle
