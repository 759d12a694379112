// Where the probe is, and coordinates in the frame that a word wants.
#include "backends/common/Waits.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Flow.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace dotek::backends::fanuc {

namespace {

constexpr double kFirstOfMachine = 1000; // number of a variable: an offset, perhaps

struct Facts {
  Distance distance = Distance::Absolute;
  std::array<bool, 3> start{};
  bool feed = false;
  bool reached = false;
};

bool merge(Facts& into, const Facts& from) {
  if (!into.reached) {
    into = from;
    into.reached = true;
    return true;
  }
  bool changed = false;
  if (into.distance != from.distance && into.distance != Distance::Unknown) {
    into.distance = Distance::Unknown;
    changed = true;
  }
  if (into.feed && !from.feed) {
    into.feed = false;
    changed = true;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    changed = changed || (from.start[i] && !into.start[i]);
    into.start[i] = into.start[i] || from.start[i];
  }
  return changed;
}

Facts behind(const ir::CycleStatement& statement, Facts facts) {
  match(
      statement,
      [&](const ir::SetMode& node) {
        if (node.mode == ir::Mode::Absolute) facts.distance = Distance::Absolute;
        if (node.mode == ir::Mode::Incremental) facts.distance = Distance::Incremental;
        if (node.mode == ir::Mode::WorkSystem) facts.start = {true, true, true};
      },
      [&](const ir::Move& node) {
        const bool macro = node.motion == ir::Motion::Protected;
        facts.feed = !macro && (facts.feed || node.feed != nullptr);
      },
      [&](const ir::Measure& node) {
        for (std::size_t i = 0; node.setting && i < 3; ++i)
          if (node.setting->nominal[i] != nullptr) facts.start[i] = true;
        facts.feed = false;
      },
      [&](const ir::CallCycle& node) {
        for (std::size_t i = 0; i < 3; ++i)
          facts.start[i] = facts.start[i] || (node.setting && node.setting->axes[i]) ||
                           (node.setsTool && i == ir::indexOf(ir::Axis::Z));
        facts.feed = false;
      },
      [&](const ir::Store& node) {
        const double* number = ir::constantValue(node.number);
        if (number == nullptr || *number >= kFirstOfMachine) facts.start = {true, true, true};
      },
      [&](const ir::OpaqueBlock& node) {
        facts.distance = Distance::Unknown;
        facts.start = {true, true, true};
        facts.feed = facts.feed || std::any_of(node.words.begin(), node.words.end(),
                                               [](const ir::Word& word) { return word.address == 'F'; });
      },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::ProbePower, ir::Comment, ir::Assign, ir::Return,
                         ir::Spindle, ir::Coolant, ir::Dwell, ir::Stop, ir::Alarm, ir::Port,
                         ir::Print> auto&) {});
  return facts;
}

ir::ExpressionPtr sum(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return tidy(ir::binary(ir::BinaryOp::Add, a, b));
}

ir::ExpressionPtr withRange(const ir::ExpressionPtr& expression, SourceRange range) {
  if (expression->range.hasPlace()) return expression;
  auto copy = std::make_shared<ir::Expression>(*expression);
  copy->range = range;
  return copy;
}

bool isAuxiliary(const State& state, const ir::OpaqueBlock& block) {
  return std::all_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
    const double* value = word.value == nullptr ? nullptr : ir::constantValue(word.value);
    if (word.address != 'M' || value == nullptr || !(*value >= 0 && *value < kFirstOfMachine)) return false;
    const auto* code =
        state.options.sourceControl.find('M', static_cast<std::uint32_t>(std::lround(*value * 10)));
    return code != nullptr && code->function == stdlib::Function::Auxiliary;
  });
}

// The body with comments in the place of copied codes that move nothing and change no mode, and of waits.
ir::Cycle withoutAuxiliary(const State& state) {
  ir::Cycle out = state.cycle;
  for (ir::CycleStatement& statement : out.body)
    if (const auto* block = std::get_if<ir::OpaqueBlock>(&statement.node);
        block && (isAuxiliary(state, *block) || isWait(*block, state.options.sourceControl)))
      statement.node = ir::Comment{};
  return out;
}

} // namespace

Body findBody(const State& state) {
  const ir::Cycle moving = withoutAuxiliary(state);
  const auto& list = moving.body;
  Body out;
  out.positions = ir::positions(moving);
  for (const ir::CycleStatement* last : ir::lastMeasurements(moving))
    out.last.push_back(last == nullptr ? nullptr
                                       : &state.cycle.body[static_cast<std::size_t>(last - list.data())]);
  std::vector<Facts> facts(list.size());
  const auto next = ir::successors(list);
  std::deque<std::size_t> open;
  if (!list.empty()) {
    facts[0].reached = true;
    open.push_back(0);
  }
  for (; !open.empty(); open.pop_front()) {
    const std::size_t at = open.front();
    const Facts after = behind(list[at], facts[at]);
    for (const std::size_t to : next[at])
      if (to < list.size() && merge(facts[to], after)) open.push_back(to);
  }
  for (const Facts& fact : facts) {
    out.distance.push_back(fact.distance);
    out.feed.push_back(fact.feed);
    out.staleStart.push_back(fact.start);
  }
  return out;
}

bool isOfContact(State& state, const ir::Move& move, const ir::Origin& origin) {
  if (move.point != ir::ProbePoint::Contact) return false;
  state.refuse<diag::FrameRefused>(origin.range(), "a move", "coordinates of the contact point");
  return true;
}

ir::ExpressionPtr workPosition(State& state, ir::Axis axis) {
  const std::size_t i = ir::indexOf(axis);
  const ir::AxisPosition& position = state.body->positions[state.at][i];
  if (position.state == ir::AxisPosition::State::Unknown) return nullptr;
  if (position.state == ir::AxisPosition::State::Work) return position.value;
  const ir::ExpressionPtr start = state.start(axis);
  return position.value == nullptr ? start : sum(start, position.value);
}

ir::ExpressionPtr positionNow(State& state, ir::Axis axis, const ir::Origin& origin) {
  const stdlib::SystemVariables& v = state.control.variables;
  const std::optional<stdlib::LengthInPositions>& with = state.control.withToolLength;
  const bool held = axis == ir::Axis::Z && (!with || with->position);
  const auto* wait = state.control.find(stdlib::Function::MachineCoordinates);
  if (!v.position || (held && (!with || !v.toolLength)) || wait == nullptr || wait->grade == "assumed")
    return nullptr;
  if (state.waited != state.sheet.size()) writeWait(state, origin);
  state.waited = state.sheet.size();
  const int i = static_cast<int>(ir::indexOf(axis));
  const ir::ExpressionPtr now = systemVariable(*v.position + i);
  return held ? ir::binary(ir::BinaryOp::Subtract, now, systemVariable(*v.toolLength + i)) : now;
}

ir::ExpressionPtr place(State& state, const ir::Coordinate& coordinate, ir::Axis axis, ir::Frame wanted,
                        SourceRange range) {
  if (coordinate.frame == wanted && coordinate.system == nullptr) return coordinate.value;
  const std::string letter(1, ir::letterOf(axis));
  if (coordinate.system != nullptr) {
    state.refuse<diag::FrameRefused>(range, letter, "a work system of its own");
    return nullptr;
  }
  ir::ExpressionPtr work;
  switch (coordinate.frame) {
  case ir::Frame::Work: work = coordinate.value; break;
  case ir::Frame::Start:
    if (state.body->staleStart[state.at][ir::indexOf(axis)]) {
      state.refuse<diag::StartUnknown>(range, letter);
      return nullptr;
    }
    work = sum(state.start(axis), coordinate.value);
    break;
  case ir::Frame::Retract: {
    const auto fixed = state.options.fixed.find("retract");
    const auto host = state.findHost("retract");
    if (fixed == state.options.fixed.end() && !host) {
      state.refuse<diag::RetractUnknown>(range);
      return nullptr;
    }
    work = sum(fixed != state.options.fixed.end() ? ir::constant(fixed->second) : ir::variable(*host),
               coordinate.value);
    break;
  }
  case ir::Frame::Machine:
    state.refuse<diag::FrameRefused>(range, letter, "machine coordinates");
    return nullptr;
  case ir::Frame::Here:
    if (const ir::ExpressionPtr here = workPosition(state, axis)) work = sum(here, coordinate.value);
    break;
  }
  if (work != nullptr && wanted == ir::Frame::Here) {
    const ir::ExpressionPtr here = workPosition(state, axis);
    work = here == nullptr ? nullptr : tidy(ir::binary(ir::BinaryOp::Subtract, work, here));
  }
  if (work == nullptr) {
    state.refuse<diag::StartUnknown>(range, letter);
    return nullptr;
  }
  return withRange(work, coordinate.value->range);
}

} // namespace dotek::backends::fanuc
