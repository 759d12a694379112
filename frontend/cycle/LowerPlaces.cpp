// Where the probe is: `here`, `start` and `move to start`. What the moves before come to is known when all of
// them are, so each leaves a mark that is resolved at the end.
#include "frontend/cycle/Link.h"
#include "frontend/cycle/Lowering.h"
#include "frontend/cycle/Walk.h"
#include "ir/Positions.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "support/messages/Cycle.h"

#include <algorithm>

namespace dotek::frontend::cycle {
namespace {

using State = ir::AxisPosition::State;

// Optional parameters of what is called that the call gives no value.
std::set<std::string> leftOut(const Call& call) {
  std::set<std::string> out;
  for (const Statement* const one : declarations(*call.called))
    if (const auto* parameter = std::get_if<Parameter>(&one->node);
        parameter != nullptr && parameter->optional)
      for (const Name& name : parameter->names)
        out.insert(name.text);
  for (const std::vector<Argument>* list : {&call.arguments, &call.handedOn})
    for (const Argument& argument : *list)
      out.erase(argument.name.text);
  return out;
}

bool isZero(const ir::ExpressionPtr& value) {
  const double* known = ir::constantValue(value);
  return known != nullptr && *known == 0;
}

std::string startName(ir::Axis axis) {
  return std::string("start_") + "xyz"[ir::indexOf(axis)];
}

} // namespace

ir::ExpressionPtr Lowering::host(std::string_view name, ir::Kind kind) {
  const auto found = hosts_.find(name);
  if (found != hosts_.end()) return ir::variable(found->second);
  ir::Variable variable;
  variable.name = std::string(name);
  variable.kind = kind;
  variable.role = ir::Role::Host;
  variable.unit = std::string(ir::kindUnit(kind));
  const ir::VariableId id = cycle_.add(std::move(variable));
  hosts_.emplace(name, id);
  return ir::variable(id);
}

void Lowering::noteShifts(const Block& block, const std::set<std::string>& absent) {
  std::set<const Statement*> unreached;
  eachStatement(block, [&](const Statement& one) {
    if (const auto* choice = std::get_if<If>(&one.node))
      for (const If::Part& part : choice->parts)
        if (const auto* given = std::get_if<Given>(&part.condition->node);
            given != nullptr && absent.contains(given->name.text))
          eachStatement(part.body, [&](const Statement& inside) { unreached.insert(&inside); });
    if (unreached.contains(&one)) return;
    if (const auto* set = std::get_if<SetOffset>(&one.node))
      for (const Becomes& item : set->items)
        if (const auto axis = linear(item.axis)) scope_.shifted[ir::indexOf(*axis)] = true;
    if (const auto* call = std::get_if<Call>(&one.node); call != nullptr && call->called != nullptr)
      noteShifts(call->called->body, leftOut(*call));
  });
}

ir::ExpressionPtr Lowering::here(ir::Axis axis, SourceRange range) {
  const ir::VariableId id = local(std::string("here_") + "xyz"[ir::indexOf(axis)], ir::Kind::Length, range);
  places_.emplace(id, axis);
  emit(ir::Assign{id, ir::constant(0, range)}, range, "where the probe is");
  return ir::variable(id, range);
}

ir::ExpressionPtr Lowering::start(ir::Axis axis, SourceRange range) {
  const std::size_t i = ir::indexOf(axis);
  if (scope_.shifted[i]) refuse<diag::StartShifted>(range, std::string(1, "xyz"[i]));
  if (!scope_.inlined) return host(startName(axis), ir::Kind::Length);
  if (!scope_.start[i]) {
    const ir::VariableId id = local(startName(axis), ir::Kind::Length, range);
    places_.emplace(id, axis);
    starts_.insert(id);
    scope_.start[i] = id;
    ir::CycleStatement read;
    read.node = ir::Assign{id, ir::constant(0, range)};
    read.origin.ranges = {range};
    read.origin.reason = "where the called cycle begins";
    read.origin.place = site_;
    out_->insert(out_->begin() + static_cast<std::ptrdiff_t>(scope_.begin), std::move(read));
  }
  return ir::variable(*scope_.start[i], range);
}

void Lowering::moveToStart(const Move& move, SourceRange range) {
  ir::Move out;
  out.motion = static_cast<ir::Motion>(move.kind);
  for (const ir::Axis axis : ir::kAxes) {
    ir::Coordinate coordinate;
    if (scope_.inlined)
      coordinate = {start(axis, range), ir::Frame::Work, nullptr};
    else
      coordinate = {ir::constant(0), ir::Frame::Start, nullptr};
    out.axes[ir::indexOf(axis)] = std::move(coordinate);
  }
  if (move.feed != nullptr) out.feed = value(*move.feed);
  emit(std::move(out), range).origin.block = ++startMoves_;
}

Lowering::Sign Lowering::signOf(const ir::ExpressionPtr& expression) const {
  const auto flipped = [](Sign sign) { return Sign{sign.below, sign.above, sign.apart}; };
  if (const double* known = ir::constantValue(expression)) return {*known >= 0, *known <= 0, *known != 0};
  if (const auto* use = std::get_if<ir::VariableUse>(&expression->node)) {
    const ir::Variable& variable = cycle_.variable(use->variable);
    if (variable.role == ir::Role::Host) {
      const bool length = variable.name == "tool_radius" || variable.name == "overtravel";
      return {length, false, length};
    }
    if (const auto once = lasting_.find(use->variable); once != lasting_.end()) return signOf(once->second);
    const auto found = signs_.find(use->variable);
    return found == signs_.end() ? Sign{} : found->second;
  }
  if (const auto* one = std::get_if<ir::Unary>(&expression->node)) {
    const Sign inner = signOf(one->operand);
    if (one->op == ir::UnaryOp::Negate) return flipped(inner);
    const bool length = one->op == ir::UnaryOp::Absolute || one->op == ir::UnaryOp::SquareRoot;
    return {length, false, length && inner.apart};
  }
  const auto* both = std::get_if<ir::Binary>(&expression->node);
  if (both == nullptr) return {};
  const auto sum = [](Sign a, Sign b) {
    const bool above = a.above && b.above, below = a.below && b.below;
    return Sign{above, below, (above || below) && (a.apart || b.apart)};
  };
  const Sign left = signOf(both->left), right = signOf(both->right);
  if (both->op == ir::BinaryOp::Add) return sum(left, right);
  if (both->op == ir::BinaryOp::Subtract) return sum(left, flipped(right));
  if (both->op == ir::BinaryOp::Multiply || both->op == ir::BinaryOp::Divide)
    return {(left.above && right.above) || (left.below && right.below),
            (left.above && right.below) || (left.below && right.above),
            left.apart && (right.apart || both->op == ir::BinaryOp::Divide)};
  return {};
}

// The two moves of `move to start`: z first where the start lies higher, x and y first where it lies lower.
void Lowering::toStart(const ir::CycleStatement& marked, const ir::ExpressionPtr& height,
                       const std::array<bool, 3>& same) {
  const auto& whole = std::get<ir::Move>(marked.node);
  const SourceRange range = marked.origin.range();
  const auto part = [&](bool z) {
    ir::Move move;
    move.motion = whole.motion;
    move.feed = whole.feed;
    bool any = false;
    for (const ir::Axis axis : ir::kAxes) {
      const std::size_t i = ir::indexOf(axis);
      if ((axis == ir::Axis::Z) != z || same[i]) continue;
      move.axes[i] = whole.axes[i];
      // A z of the work system is that of the lowest point; one from the start is of any point of the probe.
      if (z && move.axes[i]->frame == ir::Frame::Work) move.point = ir::ProbePoint::Lowest;
      any = true;
    }
    if (any) emit(std::move(move), range);
  };
  if (same[2] || (same[0] && same[1])) {
    part(true);
    part(false);
    return;
  }
  const Sign sign = signOf(height);
  if (sign.below || sign.above) {
    part(sign.below);
    part(!sign.below);
    return;
  }
  const ir::LabelId higher = label("start_is_lower", range), end = label("at_start", range);
  emit(ir::Branch{ir::compare(ir::Relation::Greater, height, ir::constant(0), range), higher}, range);
  part(true);
  part(false);
  emit(ir::Jump{end}, range);
  place(higher, range);
  part(false);
  part(true);
  place(end, range);
}

void Lowering::resolvePlaces() {
  if (places_.empty() && startMoves_ == 0 && ways_.empty()) return;
  // Adds the hosts that the places need before they are read.
  for (const ir::Axis axis : ir::kAxes)
    if (std::any_of(places_.begin(), places_.end(), [&](const auto& one) { return one.second == axis; }) ||
        (startMoves_ != 0 && axis == ir::Axis::Z))
      host(startName(axis), ir::Kind::Length);
  const std::vector<ir::Position> known = ir::positions(cycle_, places_);
  const std::vector<std::array<bool, 3>> shifted = shiftedBefore(cycle_.body);
  const auto work = [&](std::size_t before, ir::Axis axis) -> ir::ExpressionPtr {
    const ir::AxisPosition& at = known[before][ir::indexOf(axis)];
    if (at.state == State::Unknown) return nullptr;
    if (at.state == State::Work) return at.value;
    if (shifted[before][ir::indexOf(axis)]) return nullptr; // the start has other coordinates now
    const ir::ExpressionPtr from = host(startName(axis), ir::Kind::Length);
    return isZero(at.value) ? from : ir::binary(ir::BinaryOp::Add, from, at.value);
  };
  std::vector<ir::CycleStatement> list = std::move(cycle_.body);
  cycle_.body.clear();
  out_ = &cycle_.body;
  std::map<ir::VariableId, int> assigned;
  for (const auto* statements : {&cycle_.checks, &list})
    for (const ir::CycleStatement& statement : *statements)
      if (const auto* assign = std::get_if<ir::Assign>(&statement.node)) ++assigned[assign->variable];
  for (std::size_t i = 0; i < list.size(); ++i) {
    ir::CycleStatement& statement = list[i];
    const SourceRange range = statement.origin.range();
    site_ = statement.origin.place;
    const auto unknown = [&](ir::Axis axis) {
      const std::string letter(1, "xyz"[ir::indexOf(axis)]);
      const bool zKnown = known[i][ir::indexOf(ir::Axis::Z)].state != State::Unknown;
      const std::string to = fmt::format("`move to {} ..`", letter);
      refuse<diag::PlaceUnknown>(
          range, letter, site_ == 0 ? "here" : "where `" + sites_[site_ - 1].called + "` is called",
          axis == ir::Axis::Z || !zKnown ? to : "`move to start`, a place that no `set` moves, or " + to);
    };
    if (auto* assign = std::get_if<ir::Assign>(&statement.node)) {
      if (guards_.contains(assign->variable)) {
        resolveGuard(list, i, work(i, ir::Axis::Z), [&] { unknown(ir::Axis::Z); });
        i += 3;
        continue;
      }
      const auto asked = places_.find(assign->variable);
      if (asked != places_.end()) {
        const ir::AxisPosition& at = known[i][ir::indexOf(asked->second)];
        assign->value = work(i, asked->second);
        if (assign->value == nullptr) {
          if (at.state == State::Start && starts_.contains(assign->variable))
            placesOnly_.insert(assign->variable);
          else
            unknown(asked->second);
          assign->value = ir::constant(0);
        }
        began_[assign->variable] = at;
        // Of a called cycle that begins where another did: the same coordinate, by the name that it has.
        const auto* use = std::get_if<ir::VariableUse>(&assign->value->node);
        if (use != nullptr && assigned[assign->variable] == 1 && starts_.contains(assign->variable) &&
            cycle_.variable(use->variable).role == ir::Role::Host) {
          same_.emplace(assign->variable, use->variable);
          lasting_[assign->variable] = assign->value;
          continue;
        }
      }
      if (assigned[assign->variable] == 1 && cycle_.variable(assign->variable).role == ir::Role::Local &&
          isOfCaller(assign->value))
        lasting_[assign->variable] = assign->value;
    }
    if (const auto* branch = std::get_if<ir::Branch>(&statement.node);
        branch != nullptr && ways_.contains(branch->target) &&
        signOf(std::get<ir::Comparison>(branch->condition->node).left).apart) {
      i += 2; // the alarm and the label
      continue;
    }
    const bool marked = std::holds_alternative<ir::Move>(statement.node) && statement.origin.block != 0;
    statement.origin.block = 0;
    if (!marked) {
      cycle_.body.push_back(std::move(statement));
      continue;
    }
    auto& move = std::get<ir::Move>(statement.node);
    std::array<bool, 3> same{};
    ir::ExpressionPtr height;
    for (const ir::Axis axis : ir::kAxes) {
      const std::size_t a = ir::indexOf(axis);
      const ir::AxisPosition& at = known[i][a];
      ir::Coordinate& to = *move.axes[a];
      ir::ExpressionPtr away; // here less start; nullptr: not known
      if (to.frame == ir::Frame::Start) {
        if (at.state == State::Start) away = at.value;
        if (at.state == State::Work && axis == ir::Axis::Z)
          away = ir::binary(ir::BinaryOp::Subtract, at.value, host(startName(axis), ir::Kind::Length));
      } else {
        const ir::VariableId start = std::get<ir::VariableUse>(to.value->node).variable;
        away = awayFrom(at, start);
        if (placesOnly_.contains(start)) {
          if (lasts(began_.at(start).value))
            to = {began_.at(start).value, ir::Frame::Start, nullptr};
          else
            unknown(axis);
        } else if (const ir::ExpressionPtr here = work(i, axis); away == nullptr && here != nullptr) {
          away = ir::binary(ir::BinaryOp::Subtract, here, to.value);
        }
      }
      same[a] = away != nullptr && isZero(away);
      // Its coordinates are others now, the way is what it was.
      if (to.frame == ir::Frame::Start && shifted[i][a] && away != nullptr && !same[a])
        to = {ir::unary(ir::UnaryOp::Negate, away), ir::Frame::Here, nullptr};
      if (axis != ir::Axis::Z) continue;
      height = away;
      if (away == nullptr) continue;
      // Also where it has come back by another path than the travels tell.
      const Sign sign = signOfDifference(away, ir::constant(0));
      same[a] = same[a] || (sign.above && sign.below);
    }
    if (height == nullptr && !(same[0] && same[1])) {
      unknown(ir::Axis::Z);
      continue;
    }
    toStart(statement, height, same);
  }
  refuseShiftedStarts();
  ir::rename(cycle_.body, same_);
  site_ = 0;
}

// `start` as a value in a called cycle, after a `set` of its caller.
void Lowering::refuseShiftedStarts() {
  if (placesOnly_.empty()) return;
  for (const ir::CycleStatement& statement : cycle_.body)
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::VariableUse>(&node.node);
      if (use == nullptr || !placesOnly_.contains(use->variable)) return;
      site_ = statement.origin.place;
      refuse<diag::StartShifted>(statement.origin.range(),
                                 std::string(1, "xyz"[ir::indexOf(places_.at(use->variable))]));
    });
}

// It means what it meant where it was taken.
bool Lowering::lasts(const ir::ExpressionPtr& value) const {
  bool out = true;
  ir::eachNode(value, [&](const ir::Expression& node) {
    const auto* use = std::get_if<ir::VariableUse>(&node.node);
    out = out && !std::holds_alternative<ir::MeasuredResult>(node.node) &&
          (use == nullptr || cycle_.variable(use->variable).role != ir::Role::Local);
  });
  return out;
}

// How far the probe has come from where a called cycle began, where the travels say it alone; else nullptr.
ir::ExpressionPtr Lowering::awayFrom(const ir::AxisPosition& at, ir::VariableId start) const {
  const auto found = began_.find(start);
  if (found == began_.end() || at.state == State::Unknown || found->second.state != at.state) return nullptr;
  const ir::ExpressionPtr& from = found->second.value;
  if (!lasts(from)) return nullptr;
  if (isZero(from) && at.state == State::Start) return at.value;
  ir::ExpressionPtr rest = at.value, out = ir::constant(0);
  while (!ir::equal(rest, from)) {
    const auto* sum = std::get_if<ir::Binary>(&rest->node);
    if (sum == nullptr || sum->op != ir::BinaryOp::Add) return nullptr;
    out = isZero(out) ? sum->right : ir::binary(ir::BinaryOp::Add, sum->right, out);
    rest = sum->left;
  }
  return out;
}

// Values of touches and places that nothing reads.
void Lowering::dropUnread() {
  std::set<ir::VariableId> read;
  for (const auto* list : {&cycle_.checks, &cycle_.body})
    for (const ir::CycleStatement& statement : *list)
      ir::eachNode(statement, [&](const ir::Expression& node) {
        if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) read.insert(use->variable);
      });
  std::erase_if(cycle_.body, [&](const ir::CycleStatement& statement) {
    const auto* assign = std::get_if<ir::Assign>(&statement.node);
    return assign != nullptr && !read.contains(assign->variable) &&
           (touched_.contains(assign->variable) || places_.contains(assign->variable));
  });
}

} // namespace dotek::frontend::cycle
