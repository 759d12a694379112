// A cycle written statement by statement, run by its meaning, for tests.
#pragma once

#include "tests/unit/IrHelper.h"
#include "tests/unit/PartHelper.h"
#include "verify/CycleStand.h"
#include "verify/DrawnPath.h"

#include <cmath>
#include <doctest/doctest.h>

namespace dotek::tests {

using ir::Axis;
using ir::Frame;

inline constexpr double kExact = 2e-6; // lengths lie on a grid of a nanometre
inline constexpr double kBall = 3;

inline ir::ExpressionPtr operator-(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Subtract, a, b);
}
inline ir::ExpressionPtr middle(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Divide, ir::binary(ir::BinaryOp::Add, a, b), ir::constant(2));
}

// A cycle written statement by statement, and the probe above X0 Y0 Z0 of G54.
struct Bench {
  ir::Cycle cycle;
  verify::Entry entry;
  sim::CycleInputs inputs;
  sim::Probe probe;
  Limits limits;
  verify::CycleStand stand{limits};
  std::optional<sim::Part> part;
  std::set<std::uint32_t> stores;

  Bench() {
    probe.ballDiameter = 2 * kBall;
    probe.effectiveRadius = kBall;
    probe.length = verify::kToolLength;
    probe.stemDiameter = 3;
    probe.stemLength = 60;
    probe.bodyDiameter = 40;
    probe.bodyLength = 50;
    entry.probeOn = true;
  }

  template <class Node> void add(Node node) { cycle.body.push_back(statement(std::move(node))); }
  ir::ExpressionPtr variable(const std::string& name, ir::Kind kind = ir::Kind::Length) {
    return ir::variable(cycle.add(local(name, kind)));
  }
  void assign(const ir::ExpressionPtr& to, ir::ExpressionPtr value) {
    add(ir::Assign{std::get<ir::VariableUse>(to->node).variable, std::move(value)});
  }
  void move(ir::Motion motion, Frame frame, std::array<ir::ExpressionPtr, 3> to,
            ir::ProbePoint point = ir::ProbePoint::Lowest) {
    ir::Move node;
    node.motion = motion;
    node.point = point;
    for (std::size_t i = 0; i < to.size(); ++i)
      if (to[i]) node.axes[i] = ir::Coordinate{to[i], frame, nullptr};
    add(std::move(node));
  }
  void move(ir::Motion motion, Frame frame, std::optional<double> x, std::optional<double> y,
            std::optional<double> z, ir::ProbePoint point = ir::ProbePoint::Lowest) {
    const auto value = [](std::optional<double> v) { return v ? ir::constant(*v) : nullptr; };
    move(motion, frame, {value(x), value(y), value(z)}, point);
  }
  // Leaves what it measured in the variable.
  ir::ExpressionPtr touch(Axis axis, double distance, const std::string& name, Frame frame = Frame::Here) {
    ir::Measure node;
    node.axis = axis;
    node.target = ir::Coordinate{ir::constant(distance), frame, nullptr};
    add(std::move(node));
    constexpr ir::ResultName kPlaces[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                          ir::ResultName::PositionZ};
    const ir::ExpressionPtr out = variable(name);
    assign(out, ir::result(kPlaces[ir::indexOf(axis)]));
    return out;
  }
  void set(Axis axis, double distance, double system, double nominal) {
    ir::Measure node;
    node.axis = axis;
    node.target = ir::Coordinate{ir::constant(distance), Frame::Here, nullptr};
    ir::OffsetSetting setting;
    setting.system = ir::constant(system);
    setting.nominal[ir::indexOf(axis)] = ir::constant(nominal);
    node.setting = std::move(setting);
    add(std::move(node));
  }
  // The value ends up in the variable of the machine.
  void keep(std::uint32_t number, ir::ExpressionPtr value) {
    add(ir::Store{ir::constant(number), std::move(value)});
    stores.insert(number);
  }

  // Points in G54.
  void box(const Point3& least, const Point3& most) {
    PartBuilder builder;
    builder.box(least, most);
    take(builder);
  }
  void take(PartBuilder& builder, const sim::Placement& error = {}) {
    part = finish(builder)->placed({verify::standZeros()[0], {}}, error);
  }
  verify::Record run(std::uint64_t seed = 0) {
    entry.noiseSeed = seed;
    sim::World world(part.value_or(sim::Part()), probe);
    return stand.run(cycle, inputs, world, entry, stores);
  }
};

inline void near(const Point3& a, const Point3& b) {
  CHECK(a.x == doctest::Approx(b.x).epsilon(1e-9));
  CHECK(a.y == doctest::Approx(b.y).epsilon(1e-9));
  CHECK(a.z == doctest::Approx(b.z).epsilon(1e-9));
}

} // namespace dotek::tests
