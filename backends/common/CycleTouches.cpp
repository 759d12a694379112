#include "backends/common/CycleTouches.h"

#include "stdlib/MacroCycle.h"

#include <string>

namespace dotek::backends {

namespace {

// One surface along the axis; false: the cycle states no target there.
bool addSurface(const ir::CallCycle& cycle, ir::Axis axis, std::vector<ir::Measure>& out) {
  const std::string parameter =
      std::string(stdlib::roleName(stdlib::ArgumentRole::Target)) + " " + "xyz"[ir::indexOf(axis)];
  for (const ir::CycleArgument& one : cycle.arguments) {
    if (one.parameter != parameter || !one.frame) continue;
    ir::Measure measure;
    measure.axis = axis;
    measure.target = ir::Coordinate{one.value, *one.frame, nullptr};
    const std::size_t i = ir::indexOf(axis);
    if (cycle.setting && cycle.setting->axes[i]) {
      measure.setting.emplace();
      measure.setting->system = cycle.setting->system;
      // Without a nominal the feature gets the coordinate at which it is expected.
      measure.setting->nominal[i] = cycle.setting->nominal[i] ? cycle.setting->nominal[i] : one.value;
      if (*one.frame != ir::Frame::Work && !cycle.setting->nominal[i]) return false;
    }
    out.push_back(std::move(measure));
    return true;
  }
  return false;
}

} // namespace

std::vector<ir::Measure> touchesOf(const ir::CallCycle& cycle) {
  std::vector<ir::Measure> out;
  // An inner corner without a second touch of a face: one surface along X and one along Y.
  if (cycle.cycle != stdlib::intentName(stdlib::Intent::InnerCorner) || cycle.arguments.size() != 2)
    return out;
  if (!addSurface(cycle, ir::Axis::X, out) || !addSurface(cycle, ir::Axis::Y, out)) out.clear();
  return out;
}

} // namespace dotek::backends
