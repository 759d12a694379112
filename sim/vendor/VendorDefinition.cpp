// Calls whose work a cycle of the library says: its parameters are the roles of the call's letters, its
// results what the call leaves.
#include "ir/Arithmetic.h"
#include "sim/vendor/VendorRun.h"
#include "stdlib/MacroCycle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotek::sim {

namespace {

constexpr const char* kDepth = "depth";
constexpr const char* kClearance = "clearance";

using Role = stdlib::ArgumentRole;

// Directions of touches, in degrees.
constexpr Role kDirections[] = {Role::Direction, Role::FirstAngle, Role::SecondAngle, Role::ThirdAngle};

} // namespace

Direction VendorRun::directionAt(double angle) {
  return {ir::cosine(angle, ir::AngleUnit::Degrees).value, ir::sine(angle, ir::AngleUnit::Degrees).value, 0};
}

bool VendorRun::refused(std::string_view why) {
  return meaningless(why);
}

const ir::Cycle* VendorRun::definition() {
  const auto clearance =
      argument(Role::Clearance) != nullptr ? value(Role::Clearance) : set_.probing.clearance;
  // Z makes it a touch from outside, R below 0 one from inside beyond an island.
  bool island = false;
  if (argument(Role::Depth) != nullptr) {
    if (!clearance) {
      notKnown("how far it keeps away from the surface without R is in no source");
      return nullptr;
    }
    if (*clearance == 0) {
      meaningless("what R0 means is in no source", 'R');
      return nullptr;
    }
    island = *clearance < 0;
  }
  const auto found =
      cycles_.find(island ? stdlib::islandCycle(signature_) : stdlib::libraryCycle(signature_));
  if (found != cycles_.end()) return &found->second;
  notKnown("how it measures is in no source");
  return nullptr;
}

bool VendorRun::oblique() {
  double ball = 0;
  for (const Role role : kDirections)
    if (const auto angle = value(role); angle && !radius(directionAt(*angle), ball)) return false;
  if (argument(Role::FirstAngle) != nullptr && (radiusX_ != radiusY_ || vectors_))
    return notKnown("how the calibrated radii count in an oblique direction is in no source");
  return true;
}

void VendorRun::give(const ir::Cycle& cycle, ir::Environment& values) const {
  values.resize(cycle.variables.size());
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    if (variable.role != ir::Role::Parameter) continue;
    std::optional<double> given;
    for (const stdlib::MacroArgument& one : signature_.arguments)
      if (stdlib::languageName(stdlib::roleName(one.role)) == variable.name)
        given = value(one.role, one.axis);
    if (variable.name == kDepth && given) given = start_[ir::indexOf(ir::Axis::Z)] - *given;
    if (variable.name == kClearance) given = std::abs(given ? *given : set_.probing.clearance.value_or(0));
    if (!given) given = variable.defaultValue;
    values[id] = given ? ir::Scalar::of(*given) : ir::Scalar::null();
  }
}

bool VendorRun::defined() {
  if (!oblique()) return false;
  const ir::Cycle* const cycle = definition();
  if (cycle == nullptr) return false;
  CycleInputs inputs;
  give(*cycle, inputs.values);
  inputs.ballRadius = std::max(radiusX_, radiusY_);
  inputs.stylusRadius = radiusX_;
  inputs.stylusRadiusY = radiusY_;
  const bool known = argument(Role::Overtravel) != nullptr || set_.probing.overtravel;
  if (!known) return notKnown("how far beyond the expected surface it probes is in no source");
  inputs.overtravel = overtravel({1, 0, 0});
  inputs.backOff.reset();
  const Limits limits;
  CycleRun run(machine_, *cycle, std::move(inputs), limits);
  if (!run.runFor(*this)) return false;
  take(run);
  return true;
}

void VendorRun::take(const CycleRun& run) {
  for (const auto& [name, found] : run.left()) {
    if (name == "position_x") foundPosition(ir::Axis::X, found, start_[0]);
    if (name == "position_y") foundPosition(ir::Axis::Y, found, start_[1]);
    if (name == "angle_value") found_[Output::Angle] = found;
    if (name == "angle_error") {
      found_[Output::AngleError] = found;
      angleError_ = found;
    }
    if (name != "size") continue;
    for (const stdlib::MacroArgument& one : signature_.arguments)
      if (one.role == Role::Width || one.role == Role::Diameter)
        foundSize(found, value(one.role, one.axis).value_or(0));
  }
}

} // namespace dotek::sim
