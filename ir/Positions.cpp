#include "ir/Positions.h"

#include <algorithm>

#include "ir/Dataflow.h"
#include "ir/Linear.h"
#include "ir/Walk.h"

#include <optional>
#include <string_view>
#include <utility>

namespace dotek::ir {
namespace {

using State = AxisPosition::State;

// Travels that are added up before a position counts as unknown: keeps expressions small.
constexpr std::uint32_t kMostTravels = 100;
constexpr double kFirstOfMachine = 1000; // number of a variable

struct Fact {
  Position position;
  std::array<std::uint32_t, 3> travels{};
  std::array<std::optional<VariableId>, 3> copies; // variables that hold the coordinate of the place
  ExpressionPtr system;                            // active work system; null pointer: not known
  std::map<VariableId, AxisPosition> taken;        // what was known where these took the place
};

using Places = std::map<VariableId, Axis>;

void forget(AxisPosition& axis) {
  axis = {State::Unknown, nullptr, ProbePoint::Centre};
}

bool sameAxis(const AxisPosition& a, const AxisPosition& b) {
  return a.state == b.state && a.point == b.point && equal(a.value, b.value);
}

template <class Test> bool anyNode(const ExpressionPtr& expression, const Test& test) {
  bool found = false;
  if (expression) eachNode(expression, [&](const Expression& node) { found = found || test(node); });
  return found;
}

// Forgets positions whose value holds a node for which `test` is true.
template <class Test> void forgetValues(Fact& fact, const Test& test) {
  for (AxisPosition& axis : fact.position)
    if (anyNode(axis.value, test)) forget(axis);
  std::erase_if(fact.taken, [&](const auto& one) { return anyNode(one.second.value, test); });
  if (anyNode(fact.system, test)) fact.system = nullptr;
}

bool readsMachine(const Expression& node) {
  return std::holds_alternative<MachineVariable>(node.node);
}

bool readsResult(const Expression& node) {
  return std::holds_alternative<MeasuredResult>(node.node);
}

// One is the other with its sign turned.
bool cancels(const ExpressionPtr& a, const ExpressionPtr& b) {
  const auto isMinus = [](const ExpressionPtr& one, const ExpressionPtr& other) {
    const auto* unary = std::get_if<Unary>(&one->node);
    return unary != nullptr && unary->op == UnaryOp::Negate && equal(unary->operand, other);
  };
  return isMinus(a, b) || isMinus(b, a);
}

ExpressionPtr sum(const ExpressionPtr& value, const ExpressionPtr& travel) {
  const double* a = constantValue(value);
  const double* b = constantValue(travel);
  // There and back again.
  if (cancels(value, travel)) return constant(0, travel->range);
  if (const auto* before = std::get_if<Binary>(&value->node);
      before != nullptr && before->op == BinaryOp::Add && cancels(before->right, travel))
    return before->left;
  if (a && *a == 0) return travel;
  if (b && *b == 0) return value;
  if (a && b)
    if (const auto whole = exactSum(*a, *b)) return constant(*whole, travel->range);
  return binary(BinaryOp::Add, value, travel, travel->range);
}

void moveAxis(Fact& fact, std::size_t index, const Coordinate& target, ProbePoint point) {
  AxisPosition& axis = fact.position[index];
  // The lowest point lies below the centre: along X and Y they are one.
  if (point == ProbePoint::Lowest && index != indexOf(Axis::Z)) point = ProbePoint::Centre;
  const bool lasting = !anyNode(target.value, readsMachine); // the machine changes its variables on its own
  if (target.frame == Frame::Here) {
    if (axis.state == State::Unknown) return;
    if (!lasting || ++fact.travels[index] > kMostTravels) return forget(axis);
    axis.value = sum(axis.value, target.value);
    return;
  }
  fact.travels[index] = 0;
  const bool active = !target.system || (fact.system && equal(target.system, fact.system));
  const bool told = (target.frame == Frame::Work && active) || target.frame == Frame::Start;
  if (!told || !lasting || point == ProbePoint::Contact) return forget(axis);
  axis = {target.frame == Frame::Work ? State::Work : State::Start, target.value, point};
}

// Whether `set` may be the active system.
bool mayBeActive(const ExpressionPtr& set, const Fact& fact) {
  const double* a = constantValue(set);
  const double* b = constantValue(fact.system);
  return !a || !b || *a == *b;
}

constexpr std::array<std::string_view, 3> kStartNames = {"start_x", "start_y", "start_z"};
using Starts = std::array<std::optional<VariableId>, 3>; // host inputs of the start

Starts startsOf(const Cycle& cycle) {
  Starts out;
  for (VariableId id = 0; id < cycle.variables.size(); ++id)
    for (std::size_t i = 0; i < out.size(); ++i)
      if (cycle.variables[id].role == Role::Host && cycle.variables[id].name == kStartNames[i]) out[i] = id;
  return out;
}

// Whether the value is the coordinate of the place.
bool isPlace(const ExpressionPtr& value, const AxisPosition& axis, const std::optional<VariableId>& start) {
  if (axis.state == State::Work) return equal(value, axis.value);
  if (axis.state != State::Start || !start || value == nullptr) return false;
  const auto isStart = [&](const ExpressionPtr& one) {
    const auto* use = std::get_if<VariableUse>(&one->node);
    return use != nullptr && use->variable == *start;
  };
  const double* travel = constantValue(axis.value);
  if (travel != nullptr && *travel == 0) return isStart(value);
  const auto* both = std::get_if<Binary>(&value->node);
  return both != nullptr && both->op == BinaryOp::Add && isStart(both->left) &&
         equal(both->right, axis.value);
}

// What is known of the place that the coordinate is of; nullptr: nothing.
const AxisPosition* placeOf(const Coordinate& target, const Fact& fact,
                            const std::optional<VariableId>& start, const AxisPosition& entry) {
  const auto* use = std::get_if<VariableUse>(&target.value->node);
  if (target.frame != Frame::Work || target.system || use == nullptr) return nullptr;
  if (start && use->variable == *start) return &entry;
  const auto found = fact.taken.find(use->variable);
  return found == fact.taken.end() ? nullptr : &found->second;
}

// `places` as of positions(); nullptr: there are none.
Fact behind(const CycleStatement& statement, Fact fact, const Starts& starts, const Places* places) {
  const Position at = fact.position;
  // An offset that changes moves the coordinates of the place where the probe is.
  const auto shift = [&](Axis axis) {
    AxisPosition& position = fact.position[indexOf(axis)];
    if (places == nullptr || position.state != State::Start) forget(position);
    std::erase_if(fact.taken, [&](const auto& one) {
      return places->at(one.first) == axis && one.second.state != State::Start;
    });
  };
  match(
      statement,
      [&](const Move& node) {
        const AxisPosition entry{State::Start, constant(0), ProbePoint::Centre};
        for (const Axis axis : kAxes) {
          const auto& target = node.axes[indexOf(axis)];
          if (!target) continue;
          const AxisPosition* const place =
              places == nullptr ? nullptr : placeOf(*target, fact, starts[indexOf(axis)], entry);
          moveAxis(fact, indexOf(axis), *target, node.point);
          if (place != nullptr) fact.position[indexOf(axis)] = *place;
        }
      },
      [&](const Measure& node) {
        if (node.setting && mayBeActive(node.setting->system, fact))
          for (const Axis axis : kAxes)
            if (node.setting->nominal[indexOf(axis)]) shift(axis);
        forgetValues(fact, readsResult);
      },
      [&](const CallCycle& node) {
        const bool active = node.setting && mayBeActive(node.setting->system, fact);
        for (const Axis axis : kAxes) {
          const bool tool = node.setsTool && axis == Axis::Z; // its length may be the one in force
          if (!node.returns || tool)
            forget(fact.position[indexOf(axis)]);
          else if (active && node.setting->axes[indexOf(axis)])
            shift(axis);
        }
        if (node.setsTool) fact.taken.clear();
        forgetValues(fact, readsResult);
      },
      [&](const SetMode& node) {
        if (node.mode != Mode::WorkSystem) return;
        for (AxisPosition& axis : fact.position)
          forget(axis);
        fact.system = anyNode(node.system, readsMachine) ? nullptr : node.system;
      },
      [&](const Assign& node) {
        const Position before = fact.position;
        const auto takes = places == nullptr ? Places::const_iterator() : places->find(node.variable);
        const bool takesPlace = places != nullptr && takes != places->end();
        for (std::size_t i = 0; i < before.size(); ++i) {
          if (takesPlace && indexOf(takes->second) == i && before[i].state != State::Unknown)
            fact.copies[i] = node.variable;
          else if (isPlace(node.value, before[i], starts[i]))
            fact.copies[i] = node.variable;
          else if (fact.copies[i] == node.variable)
            fact.copies[i].reset();
        }
        forgetValues(fact, [&](const Expression& read) {
          const auto* use = std::get_if<VariableUse>(&read.node);
          return use && use->variable == node.variable;
        });
        for (std::size_t i = 0; i < before.size(); ++i)
          if (fact.position[i].state == State::Unknown && before[i].state != State::Unknown && fact.copies[i])
            fact.position[i] = {State::Work, variable(*fact.copies[i]), before[i].point};
        if (places == nullptr) return;
        fact.taken.erase(node.variable);
        if (takesPlace && fact.position[indexOf(takes->second)].state != State::Unknown)
          fact.taken[node.variable] = fact.position[indexOf(takes->second)];
      },
      [&](const Store& node) {
        // A variable of the machine: an offset, perhaps the one in force.
        const double* number = constantValue(node.number);
        if (number != nullptr && *number < kFirstOfMachine) return;
        for (AxisPosition& axis : fact.position)
          forget(axis);
      },
      [&](const OpaqueBlock&) {
        for (AxisPosition& axis : fact.position)
          forget(axis);
        fact.system = nullptr;
      },
      [](const OneOf<Label, Jump, Branch, Return, ProbePower, Spindle, Coolant, Dwell, Stop, Alarm, Comment,
                     Port, Print> auto&) {});
  if (!std::holds_alternative<Assign>(statement.node))
    for (std::size_t i = 0; i < at.size(); ++i)
      if (!sameAxis(at[i], fact.position[i])) fact.copies[i].reset();
  return fact;
}

bool meet(Fact& into, const Fact& other) {
  bool changed = false;
  for (std::size_t i = 0; i < into.position.size(); ++i) {
    if (into.travels[i] < other.travels[i]) into.travels[i] = other.travels[i];
    AxisPosition& axis = into.position[i];
    if (into.copies[i] && into.copies[i] != other.copies[i]) {
      into.copies[i].reset();
      changed = true;
    }
    if (axis.state == State::Unknown || sameAxis(axis, other.position[i])) continue;
    forget(axis);
    changed = true;
  }
  changed = std::erase_if(into.taken,
                          [&](const auto& one) {
                            const auto found = other.taken.find(one.first);
                            return found == other.taken.end() || !sameAxis(one.second, found->second);
                          }) > 0 ||
            changed;
  if (into.system && !equal(into.system, other.system)) {
    into.system = nullptr;
    changed = true;
  }
  return changed;
}

} // namespace

namespace {

std::vector<Position> positionsOf(const Cycle& cycle, const Places* places) {
  const Starts starts = startsOf(cycle);
  Fact entry;
  for (AxisPosition& axis : entry.position)
    axis = {State::Start, constant(0), ProbePoint::Centre};
  const auto facts = factsBefore(
      cycle.body, std::move(entry),
      [&](std::size_t at, std::size_t, const Fact& fact) {
        return behind(cycle.body[at], fact, starts, places);
      },
      meet);
  std::vector<Position> out;
  out.reserve(facts.size());
  for (const auto& fact : facts) {
    Position position;
    for (std::size_t i = 0; i < position.size(); ++i) {
      if (fact)
        position[i] = fact->position[i];
      else
        forget(position[i]);
    }
    out.push_back(std::move(position));
  }
  return out;
}

} // namespace

std::vector<Position> positions(const Cycle& cycle) {
  return positionsOf(cycle, nullptr);
}

std::vector<Position> positions(const Cycle& cycle, const std::map<VariableId, Axis>& places) {
  return positionsOf(cycle, &places);
}

std::vector<const CycleStatement*> lastMeasurements(const Cycle& cycle) {
  const auto facts = factsBefore<const CycleStatement*>(
      cycle.body, nullptr,
      [&](std::size_t at, std::size_t, const CycleStatement* last) -> const CycleStatement* {
        return match(
            cycle.body[at], [](const OpaqueBlock&) -> const CycleStatement* { return nullptr; },
            [&](const Measure&) { return &cycle.body[at]; },
            [&](const CallCycle& node) { return node.power ? last : &cycle.body[at]; },
            [&](const OneOf<Assign, Store, Label, Jump, Branch, Return, Move, ProbePower, Spindle, Coolant,
                            SetMode, Dwell, Stop, Alarm, Comment, Port, Print> auto&) { return last; });
      },
      [](const CycleStatement*& into, const CycleStatement* other) {
        if (!into || into == other) return false;
        into = nullptr;
        return true;
      });
  std::vector<const CycleStatement*> out;
  out.reserve(facts.size());
  for (const auto& fact : facts)
    out.push_back(fact ? *fact : nullptr);
  return out;
}

std::optional<bool> switchesProbe(const CycleStatement& statement) {
  if (const auto* power = std::get_if<ProbePower>(&statement.node)) return power->on;
  const auto* cycle = std::get_if<CallCycle>(&statement.node);
  return cycle == nullptr ? std::nullopt : cycle->power;
}

bool probes(const CycleStatement& statement) {
  return match(
      statement, [](const Measure&) { return true; }, [](const CallCycle& node) { return node.moves; },
      [](const Move& node) { return node.motion == Motion::Protected; },
      [](const OneOf<Assign, Store, Label, Jump, Branch, Return, ProbePower, Spindle, Coolant, SetMode, Dwell,
                     Stop, Alarm, Comment, OpaqueBlock, Port, Print> auto&) { return false; });
}

bool probes(const Cycle& cycle) {
  return std::any_of(cycle.body.begin(), cycle.body.end(),
                     [](const CycleStatement& statement) { return probes(statement); });
}

bool countsFrom(const Cycle& cycle, Frame frame) {
  const auto counts = [&](const std::optional<Coordinate>& coordinate) {
    return coordinate && coordinate->frame == frame;
  };
  return std::any_of(cycle.body.begin(), cycle.body.end(), [&](const CycleStatement& statement) {
    return match(
        statement, [&](const Measure& node) { return counts(node.target); },
        [&](const CallCycle& node) {
          return std::any_of(node.arguments.begin(), node.arguments.end(),
                             [&](const CycleArgument& argument) { return argument.frame == frame; });
        },
        [&](const Move& node) { return std::any_of(node.axes.begin(), node.axes.end(), counts); },
        [](const OneOf<Assign, Store, Label, Jump, Branch, Return, ProbePower, Spindle, Coolant, SetMode,
                       Dwell, Stop, Alarm, Comment, OpaqueBlock, Port, Print> auto&) { return false; });
  });
}

} // namespace dotek::ir
