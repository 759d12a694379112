// Touches of the cycle language as calls of macros: those along a direction, and those that may find nothing.
#include "backends/common/MacroCall.h"
#include "backends/fanuc/OwnCycles.h"
#include "ir/CycleNames.h"
#include "ir/Fold.h"
#include "stdlib/MacroSet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dotek::backends::fanuc {
namespace {

using ir::ExpressionPtr;

constexpr std::size_t kZ = 2;
constexpr double kHalfTurn = 180;

ExpressionPtr take(const ir::CallCycle& cycle, std::string_view parameter) {
  for (const ir::CycleArgument& one : cycle.arguments)
    if (one.parameter == parameter) return ir::simplify(one.value);
  return nullptr;
}

std::array<ExpressionPtr, 3> partsOf(const ir::CallCycle& cycle) {
  return {take(cycle, "direction x"), take(cycle, "direction y"), take(cycle, "direction z")};
}

bool isZero(const ExpressionPtr& part) {
  const double* const value = part == nullptr ? nullptr : ir::constantValue(part);
  return part == nullptr || (value != nullptr && *value == 0);
}

ExpressionPtr times(const ExpressionPtr& a, const ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Multiply, a, b);
}
ExpressionPtr plus(const ExpressionPtr& a, const ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Add, a, b);
}
ExpressionPtr minus(const ExpressionPtr& a, const ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Subtract, a, b);
}

// The angle where the parts are its cosine and its sine, both as they are or both negative; nullptr: they are
// others.
ExpressionPtr angleOf(const ExpressionPtr& x, const ExpressionPtr& y) {
  if (x == nullptr || y == nullptr) return nullptr;
  const auto* minusX = std::get_if<ir::Unary>(&x->node);
  const auto* minusY = std::get_if<ir::Unary>(&y->node);
  if (minusX != nullptr && minusY != nullptr && minusX->op == ir::UnaryOp::Negate &&
      minusY->op == ir::UnaryOp::Negate) {
    const ExpressionPtr opposite = angleOf(minusX->operand, minusY->operand);
    return opposite == nullptr ? nullptr : ir::simplify(plus(opposite, ir::constant(kHalfTurn)));
  }
  const auto* cosine = std::get_if<ir::Unary>(&x->node);
  const auto* sine = std::get_if<ir::Unary>(&y->node);
  const bool both = cosine != nullptr && sine != nullptr && cosine->op == ir::UnaryOp::Cosine &&
                    sine->op == ir::UnaryOp::Sine && ir::equal(cosine->operand, sine->operand);
  return both ? cosine->operand : nullptr;
}

ExpressionPtr orZero(const ExpressionPtr& part) {
  return part == nullptr ? ir::constant(0) : part;
}

// The touch in the plane as the call that the sets have; false: it leads out of the plane, or nowhere.
bool turn(ir::CallCycle& cycle) {
  const std::array<ExpressionPtr, 3> parts = partsOf(cycle);
  ExpressionPtr travel = take(cycle, "travel");
  if (!isZero(parts[kZ]) || (isZero(parts[0]) && isZero(parts[1])) || travel == nullptr) return false;
  ExpressionPtr angle = angleOf(parts[0], parts[1]);
  if (angle == nullptr)
    angle = ir::simplify(ir::binary(ir::BinaryOp::Direction, orZero(parts[0]), orZero(parts[1]),
                                    (parts[0] == nullptr ? parts[1] : parts[0])->range));
  if (const double* const value = ir::constantValue(travel)) {
    if (*value == 0) return false;
    if (*value < 0) {
      travel = ir::constant(-*value, travel->range);
      angle = ir::simplify(plus(angle, ir::constant(kHalfTurn)));
    }
  }
  std::vector<ir::CycleArgument> arguments;
  arguments.push_back({std::string(stdlib::roleName(stdlib::ArgumentRole::Direction)), angle, std::nullopt,
                       ir::Kind::Angle, true});
  arguments.push_back({std::string(stdlib::roleName(stdlib::ArgumentRole::Distance)), travel, std::nullopt,
                       ir::Kind::Length, true});
  for (const ir::CycleArgument& one : cycle.arguments)
    if (one.parameter != "travel" && !one.parameter.starts_with("direction ")) arguments.push_back(one);
  cycle.cycle = std::string(stdlib::intentName(stdlib::Intent::AngledSurface));
  cycle.arguments = std::move(arguments);
  return true;
}

} // namespace

ir::Cycle withTouchCalls(const ir::Cycle& given, const stdlib::MacroSet& macros) {
  ir::Cycle out = given;
  for (ir::CycleStatement& statement : out.body) {
    auto* const call = std::get_if<ir::CallCycle>(&statement.node);
    if (call == nullptr || !call->set.empty()) continue;
    const bool along = call->cycle == ir::kSurfaceAlong;
    if (!along && call->cycle != ir::kSurface) continue;
    if (along && (macros.find(stdlib::Intent::AngledSurface) == nullptr || !turn(*call))) continue;
    for (ir::CycleArgument& one : call->arguments)
      if (one.parameter == "miss") one.parameter = stdlib::roleName(stdlib::ArgumentRole::FlagOnly);
  }
  return out;
}

bool isOwnTouchAlong(const ir::CycleStatement& statement) {
  const auto* const call = std::get_if<ir::CallCycle>(&statement.node);
  return call != nullptr && call->set.empty() &&
         call->cycle == stdlib::intentName(stdlib::Intent::AngledSurface);
}

void guardDistance(State& state, const ir::CallCycle& cycle, const ir::Origin& origin) {
  const ExpressionPtr distance = take(cycle, stdlib::roleName(stdlib::ArgumentRole::Distance));
  if (distance == nullptr || ir::constantValue(distance) != nullptr) return;
  if (std::any_of(state.distances.begin(), state.distances.end(),
                  [&](const ExpressionPtr& other) { return ir::equal(other, distance); }))
    return;
  if (knownAtEntry(state, distance))
    state.distances.push_back(distance);
  else
    writeDistanceAlarm(state, distance, origin);
}

void writeDistanceAlarm(State& state, const ExpressionPtr& distance, const ir::Origin& given) {
  ir::Origin origin;
  origin.ranges = given.ranges;
  origin.reason = "way of a touch";
  alarmIf(state, ir::compare(ir::Relation::LessEqual, distance, ir::constant(0)), "TOUCH HAS NO WAY", origin);
  state.releaseHelpers();
}

ExpressionPtr resultAlong(State& state, const ir::CycleStatement& measured, ir::ResultName name) {
  const auto& cycle = std::get<ir::CallCycle>(measured.node);
  const ir::Origin& origin = measured.origin;
  if (name == ir::ResultName::PositionZ) {
    // The height of the ball's centre.
    const auto ball = state.findHost("tool_radius");
    const auto fixed = state.options.fixed.find("tool_radius");
    ExpressionPtr radius;
    if (fixed != state.options.fixed.end()) radius = ir::constant(fixed->second);
    if (ball && state.isArgument(*ball)) radius = ir::variable(*ball);
    const ExpressionPtr z = positionNow(state, ir::Axis::Z, origin);
    const ExpressionPtr now = z == nullptr ? workPosition(state, ir::Axis::Z) : z;
    return radius == nullptr || now == nullptr ? nullptr : plus(now, radius);
  }
  const stdlib::MacroSignature* const signature = signatureOf(state.macros, measured);
  const ExpressionPtr angle = take(cycle, stdlib::roleName(stdlib::ArgumentRole::Direction));
  const ExpressionPtr distance = take(cycle, stdlib::roleName(stdlib::ArgumentRole::Distance));
  if (signature == nullptr || angle == nullptr || distance == nullptr) return nullptr;
  // Where the angle was made of the parts of the direction, these say it in one line.
  const auto* const made = std::get_if<ir::Binary>(&angle->node);
  const bool ofParts = made != nullptr && made->op == ir::BinaryOp::Direction;
  ExpressionPtr way;
  for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y}) {
    const bool x = axis == ir::Axis::X;
    const stdlib::MacroResult* const found =
        findResult(*signature, x ? ir::ResultName::PositionX : ir::ResultName::PositionY);
    ExpressionPtr from = positionNow(state, axis, origin);
    if (from == nullptr) from = workPosition(state, axis);
    if (found == nullptr || !found->documented || from == nullptr) return nullptr;
    const ExpressionPtr share = ofParts ? (x ? made->left : made->right)
                                        : ir::unary(x ? ir::UnaryOp::Cosine : ir::UnaryOp::Sine, angle);
    const ExpressionPtr part = times(minus(systemVariable(static_cast<int>(found->variable)), from), share);
    way = x ? part : plus(way, part);
  }
  if (ofParts) {
    const ExpressionPtr square = plus(times(made->left, made->left), times(made->right, made->right));
    way = ir::binary(ir::BinaryOp::Divide, way, ir::unary(ir::UnaryOp::SquareRoot, square));
  }
  return minus(way, distance);
}

} // namespace dotek::backends::fanuc
