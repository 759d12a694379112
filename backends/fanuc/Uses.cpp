#include "backends/fanuc/Uses.h"

#include "backends/common/Waits.h"
#include "ir/Decided.h"
#include "ir/Flow.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"

#include <algorithm>
#include <map>
#include <optional>

namespace dotek::backends::fanuc {

namespace {

using Ids = std::set<ir::VariableId>;

// Beyond this, every branch counts as one that decides on a move.
constexpr std::size_t kMostStatements = 2000;

template <class Tree> Ids idsOf(const Tree& tree) {
  Ids out;
  if (tree == nullptr) return out;
  ir::eachNode(tree, [&](const ir::Expression& node) {
    if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) out.insert(use->variable);
  });
  return out;
}

void collect(Ids& out, const ir::ExpressionPtr& expression) {
  out.merge(idsOf(expression));
}

// What a move or a measurement moves by.
Ids movesBy(const ir::CycleStatement& statement) {
  Ids out;
  match(
      statement,
      [&](const ir::Move& node) {
        for (const auto& axis : node.axes)
          if (axis) collect(out, axis->value);
        collect(out, node.feed);
      },
      [&](const ir::Measure& node) {
        if (node.target) collect(out, node.target->value);
        collect(out, node.diameter);
      },
      [&](const ir::CallCycle& node) {
        for (const ir::CycleArgument& argument : node.arguments)
          if (argument.moves) collect(out, argument.value);
      },
      [&](const ir::OpaqueBlock& node) {
        for (const ir::Word& word : node.words)
          collect(out, word.value);
      },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::ProbePower, ir::Comment, ir::Assign,
                         ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                         ir::Port, ir::Print> auto&) {});
  return out;
}

bool mayMove(const ir::CycleStatement& statement, const stdlib::Control& control) {
  return match(
      statement, [](const ir::OneOf<ir::Move, ir::Measure> auto&) { return true; },
      [](const ir::CallCycle& node) { return node.moves; },
      [&](const ir::OpaqueBlock& node) { return !isWait(node, control); },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::ProbePower, ir::Comment, ir::Assign,
                         ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                         ir::Port, ir::Print> auto&) { return false; });
}

// The statements of which nothing but an alarm comes, before anything moves.
std::vector<bool> stopping(const ir::Cycle& cycle, const std::vector<std::vector<std::size_t>>& next,
                           const stdlib::Control& control) {
  const std::size_t end = cycle.body.size();
  std::vector<bool> out(end + 1, true);
  out[end] = false;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = end; i-- > 0;) {
      if (!out[i]) continue;
      const bool goesOn =
          std::any_of(next[i].begin(), next[i].end(), [&](std::size_t to) { return !out[to]; });
      if (!goesOn && !mayMove(cycle.body[i], control)) continue;
      out[i] = false;
      changed = true;
    }
  }
  return out;
}

// What branches of the body decide on. A way that only stops is none: such a branch checks.
class Decisions {
public:
  Decisions(const ir::Cycle& cycle, const stdlib::Control& control)
      : cycle_(cycle), control_(control), next_(ir::successors(cycle.body)), ways_(waysOf()),
        decided_(ways_) {}

  // Whether the branch decides on a move, or on an assignment to one of `moving`.
  bool moves(std::size_t branch, const Ids& moving) const {
    if (cycle_.body.size() > kMostStatements) return true;
    std::vector<bool> seen(cycle_.body.size(), false);
    std::vector<std::size_t> open = {branch};
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for (const std::size_t one : decided_.by(at)) {
        if (seen[one]) continue;
        seen[one] = true;
        open.push_back(one);
        const ir::CycleStatement& statement = cycle_.body[one];
        if (mayMove(statement, control_) || setsBeforeMove(one)) return true;
        const auto* assign = std::get_if<ir::Assign>(&statement.node);
        if (assign != nullptr && moving.contains(assign->variable)) return true;
      }
    }
    return false;
  }

private:
  std::vector<std::vector<std::size_t>> waysOf() const {
    std::vector<std::vector<std::size_t>> out = next_;
    if (cycle_.body.size() > kMostStatements) return out;
    const std::vector<bool> stops = stopping(cycle_, next_, control_);
    for (std::vector<std::size_t>& places : out)
      if (std::any_of(places.begin(), places.end(), [&](std::size_t to) { return !stops[to]; }))
        std::erase_if(places, [&](std::size_t to) { return stops[to]; });
    return out;
  }

  // A work offset that is set moves what comes after it.
  bool setsBeforeMove(std::size_t at) const {
    const auto* call = std::get_if<ir::CallCycle>(&cycle_.body[at].node);
    if (call == nullptr || !call->setting) return false;
    const auto later = reachableFrom(next_, at);
    for (std::size_t i = 0; i < cycle_.body.size(); ++i)
      if (later[i] && mayMove(cycle_.body[i], control_)) return true;
    return false;
  }

  const ir::Cycle& cycle_;
  const stdlib::Control& control_;
  std::vector<std::vector<std::size_t>> next_, ways_;
  ir::Decided decided_;
};

// Whether the branch among the checks decides on an assignment to one of `wanted`, both sides of which pass
// the checks.
bool choosesAmong(const std::vector<ir::CycleStatement>& checks,
                  const std::vector<std::vector<std::size_t>>& next, std::size_t branch, const Ids& wanted) {
  if (checks.size() > kMostStatements) return true;
  if (next[branch].size() < 2) return false;
  const std::size_t end = checks.size(), one = next[branch][0], other = next[branch][1];
  const auto first = reachableFrom(next, one), second = reachableFrom(next, other);
  if ((one != end && !first[end]) || (other != end && !second[end])) return false;
  const bool loop = first[branch] || second[branch];
  for (std::size_t i = 0; i < end; ++i) {
    const bool a = first[i] || i == one, b = second[i] || i == other;
    if (loop ? !a && !b : a == b) continue;
    const auto* assign = std::get_if<ir::Assign>(&checks[i].node);
    if (assign != nullptr && wanted.contains(assign->variable)) return true;
  }
  return false;
}

// What the checks choose the values of `out` by.
void addChoosing(const std::vector<ir::CycleStatement>& checks,
                 const std::vector<std::vector<std::size_t>>& next, Ids& out) {
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const auto* branch = std::get_if<ir::Branch>(&checks[i].node);
    if (branch == nullptr) continue;
    const Ids read = idsOf(branch->condition);
    if (std::includes(out.begin(), out.end(), read.begin(), read.end())) continue;
    if (choosesAmong(checks, next, i, out)) out.insert(read.begin(), read.end());
  }
}

// With variables of the machine that the cycle sets as variables of its own, after all others: what is kept
// in #150 moves the probe where #150 does. nullopt: it sets none.
std::optional<ir::Cycle> withNamedStores(const ir::Cycle& given) {
  std::map<double, ir::VariableId> stored;
  const auto first = static_cast<ir::VariableId>(given.variables.size());
  for (const ir::CycleStatement& statement : given.body)
    if (const auto* store = std::get_if<ir::Store>(&statement.node))
      if (const double* number = ir::constantValue(store->number))
        stored.emplace(*number, first + static_cast<ir::VariableId>(stored.size()));
  if (stored.empty()) return std::nullopt;
  ir::Cycle out = given;
  for (ir::CycleStatement& statement : out.body) {
    ir::rewrite(statement, [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
      const auto* variable = std::get_if<ir::MachineVariable>(&node->node);
      const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
      const auto found = number == nullptr ? stored.end() : stored.find(*number);
      return found == stored.end() ? node : ir::variable(found->second);
    });
    const auto* store = std::get_if<ir::Store>(&statement.node);
    const double* number = store == nullptr ? nullptr : ir::constantValue(store->number);
    if (number == nullptr) continue;
    const ir::ExpressionPtr value = store->value;
    statement.node = ir::Assign{stored.at(*number), value};
  }
  return out;
}

} // namespace

Ids variablesOf(const ir::ExpressionPtr& expression) {
  return idsOf(expression);
}

Ids variablesOf(const ir::ConditionPtr& condition) {
  return idsOf(condition);
}

Ids usedVariables(const ir::Cycle& cycle) {
  Ids out;
  for (const auto* list : {&cycle.checks, &cycle.body})
    for (const ir::CycleStatement& statement : *list) {
      if (const auto* assign = std::get_if<ir::Assign>(&statement.node)) out.insert(assign->variable);
      ir::eachNode(statement, [&](const ir::Expression& node) {
        if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) out.insert(use->variable);
      });
    }
  return out;
}

bool isAssigned(const std::vector<ir::CycleStatement>& list, ir::VariableId id) {
  return std::any_of(list.begin(), list.end(), [&](const ir::CycleStatement& statement) {
    const auto* assign = std::get_if<ir::Assign>(&statement.node);
    return assign != nullptr && assign->variable == id;
  });
}

bool isStartHost(const ir::Variable& variable) {
  return variable.role == ir::Role::Host &&
         (variable.name == "start_x" || variable.name == "start_y" || variable.name == "start_z");
}

std::vector<bool> reachableFrom(const std::vector<std::vector<std::size_t>>& next, std::size_t from) {
  std::vector<bool> out(next.size() + 1, false);
  std::vector<std::size_t> open = {from};
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    if (at >= next.size()) continue;
    for (const std::size_t after : next[at]) {
      if (out[after]) continue;
      out[after] = true;
      open.push_back(after);
    }
  }
  return out;
}

Ids bodyVariables(const ir::Cycle& cycle) {
  Ids out;
  for (const ir::CycleStatement& statement : cycle.body)
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) out.insert(use->variable);
    });
  const auto next = ir::successors(cycle.checks);
  for (std::size_t before = out.size() + 1; before != out.size();) {
    before = out.size();
    for (const ir::CycleStatement& statement : cycle.checks) {
      const auto* assign = std::get_if<ir::Assign>(&statement.node);
      if (assign != nullptr && out.contains(assign->variable)) collect(out, assign->value);
    }
    addChoosing(cycle.checks, next, out);
  }
  return out;
}

Ids movingVariables(const ir::Cycle& given, const stdlib::Control& control) {
  const std::optional<ir::Cycle> named = withNamedStores(given);
  const ir::Cycle& cycle = named ? *named : given;
  Ids out;
  for (const ir::CycleStatement& statement : cycle.body)
    out.merge(movesBy(statement));
  const auto ofChecks = ir::successors(cycle.checks);
  const Decisions decisions(cycle, control);
  for (std::size_t before = out.size() + 1; before != out.size();) {
    before = out.size();
    for (const auto* list : {&cycle.checks, &cycle.body})
      for (const ir::CycleStatement& statement : *list) {
        const auto* assign = std::get_if<ir::Assign>(&statement.node);
        if (assign != nullptr && out.contains(assign->variable)) collect(out, assign->value);
      }
    addChoosing(cycle.checks, ofChecks, out);
    for (std::size_t i = 0; i < cycle.body.size(); ++i) {
      const auto* branch = std::get_if<ir::Branch>(&cycle.body[i].node);
      if (branch == nullptr) continue;
      const Ids read = idsOf(branch->condition);
      if (std::includes(out.begin(), out.end(), read.begin(), read.end())) continue;
      if (decisions.moves(i, out)) out.insert(read.begin(), read.end());
    }
  }
  out.erase(out.lower_bound(static_cast<ir::VariableId>(given.variables.size())), out.end());
  return out;
}

} // namespace dotek::backends::fanuc
