// Touches of a cycle: the search, what it measured, and the offsets that are set by it.
#include "sim/cycle/CycleRun.h"
#include "sim/machine/Measurement.h"
#include "sim/machine/Paths.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

namespace {

constexpr std::size_t kZ = 2;

constexpr ir::ResultName kPositions[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                         ir::ResultName::PositionZ};
constexpr ir::ResultName kErrors[] = {ir::ResultName::ErrorX, ir::ResultName::ErrorY, ir::ResultName::ErrorZ};

std::array<double, 3> axisDirection(std::size_t axis, double sign) {
  std::array<double, 3> out{};
  out[axis] = sign;
  return out;
}

std::string sideOf(std::size_t axis, double sign) {
  return fmt::format("{}{}", "XYZ"[axis], sign > 0 ? '+' : '-');
}

} // namespace

// Downward the lowest point touches, upward the highest; to the side the calibrated radius counts.
double CycleRun::surfaceFrom(std::size_t axis, double sign) const {
  if (axis == kZ) return sign > 0 ? 2 * inputs_.ballRadius : 0;
  return sign * calibrated(axis);
}

PlannedTouch CycleRun::plan(const Direction& direction, double distance, const Search& search) const {
  return {machine_.position(), direction, distance, search.overtravel, search.stated};
}

double CycleRun::ballAlong(const PlannedTouch& planned) const {
  if (planned.isDown()) return 0;
  if (planned.direction[kZ] != 0) return inputs_.ballRadius;
  return calibrated(planned.direction[0] != 0 ? 0 : 1);
}

void CycleRun::begin(std::span<const PlannedTouch> touches) {
  if (MotionWatcher* const watcher = this->watcher(); watcher != nullptr) watcher->touchBegins(touches);
}

void CycleRun::end() {
  if (MotionWatcher* const watcher = this->watcher(); watcher != nullptr) watcher->touchEnded();
}

// false: the run has ended.
bool CycleRun::search(const Direction& direction, double travel, const Search& how, Touched& touched) {
  const Position from = machine_.position();
  Position aim = along(from, direction, travel);
  for (int pass = 0; pass < (how.once ? 1 : 2); ++pass) { // to find it, and to measure it
    const Position began = machine_.position();
    const std::optional<bool> contact = machine_.probeTo(aim, how.mayMiss);
    if (!contact) return false;
    touched.found = *contact;
    touched.at = machine_.position();
    if (!*contact) break;
    if (distance(began, touched.at) < kNoPath) return alarm(stdlib::MacroAlarm::ProbeOpen);
    if (pass > 0 || how.once) break;
    if (!inputs_.backOff) {
      if (!goTo(from, MotionKind::Feed)) return false;
      continue;
    }
    const double back = std::min(*inputs_.backOff, distance(from, touched.at));
    aim = along(touched.at, direction, *inputs_.backOff);
    if (!goTo(along(touched.at, direction, -back), MotionKind::Feed)) return false;
  }
  return goTo(from, MotionKind::Feed);
}

bool CycleRun::touch(const PlannedTouch& planned, const Search& how, Touched& touched) {
  const double ball = ballAlong(planned);
  const double travel = planned.distance - ball + planned.overtravel;
  if (!(travel > kNoPath))
    return raise("the touch has no way to go: the surface is expected at the ball, or "
                 "beyond it by more than the overtravel");
  if (caller_ == nullptr && expected_.size() < kMostExpected) {
    const Position at = machine_.machinePosition();
    const double low = at[kZ] - inputs_.tipLength;
    const Point3 way{planned.direction[0], planned.direction[1], planned.direction[kZ]};
    const Point3 from{at[0], at[1], planned.isDown() ? low : low + inputs_.ballRadius};
    expected_.push_back({from + way * planned.distance, way, place(), planned.distance, ball});
  }
  if (nominal_) {
    touched = {along(machine_.position(), planned.direction, planned.distance - ball), true};
    return true;
  }
  return search(planned.direction, travel, how, touched);
}

bool CycleRun::notFound() {
  return alarm(stdlib::MacroAlarm::ProbeFail);
}

bool CycleRun::measure(const ir::Measure& node) {
  results_.clear();
  return node.feature == ir::Feature::Bore ? bore(node) : surface(node);
}

bool CycleRun::surface(const ir::Measure& node) {
  const std::size_t i = ir::indexOf(node.axis);
  const std::optional<double> expected = coordinate(*node.target, i, ir::ProbePoint::Lowest);
  std::array<std::optional<double>, 3> found;
  if (!expected || !touchAxis(i, *expected, usualSearch(), found[i])) return false;
  if (node.setting && !set(*node.setting, found)) return false;
  end();
  return true;
}

bool CycleRun::touchAxis(std::size_t i, double expected, const Search& how, std::optional<double>& measured) {
  const double from = machine_.position()[i];
  if (std::abs(expected - from) < kNoPath)
    return raise("the surface is expected where the probe is; which way it lies is not known");
  const double sign = expected > from ? 1 : -1;
  // Upward the way counts from the ball's centre.
  const double centre = i == kZ && sign > 0 ? inputs_.ballRadius : 0;
  const PlannedTouch planned = plan(axisDirection(i, sign), std::abs(expected - from) - centre, how);
  begin({&planned, 1});
  Touched touched;
  if (!touch(planned, how, touched)) return false;
  if (!touched.found) return how.mayMiss || notFound();
  measured = touched.at[i] + surfaceFrom(i, sign);
  results_[kPositions[i]] = *measured;
  results_[kErrors[i]] = *measured - expected;
  if (MotionWatcher* const watcher = this->watcher(); watcher != nullptr)
    watcher->measured({0, "surface " + sideOf(i, sign), {{std::string(1, "XYZ"[i]), expected, *measured}}});
  return true;
}

// Along X, then along Y through the middle that X gave, where the size is true.
bool CycleRun::bore(const ir::Measure& node) {
  const std::optional<double> diameter = number(node.diameter);
  if (!diameter) return false;
  if (!(*diameter > 0)) return raise("a diameter that is not above 0");
  const Position start = machine_.position();
  std::vector<PlannedTouch> all;
  for (const std::size_t i : {std::size_t(0), std::size_t(1)})
    for (const double sign : {1.0, -1.0})
      all.push_back(plan(axisDirection(i, sign), *diameter / 2, usualSearch()));
  begin(all);
  std::array<std::optional<double>, 3> found;
  double size = 0;
  for (const std::size_t i : {std::size_t(0), std::size_t(1)}) {
    std::array<double, 2> sides{};
    for (std::size_t side = 0; side < sides.size(); ++side) {
      PlannedTouch planned = all[2 * i + side];
      planned.from = machine_.position();
      Touched touched;
      if (!touch(planned, usualSearch(), touched)) return false;
      if (!touched.found) return notFound();
      sides[side] = touched.at[i] + surfaceFrom(i, planned.direction[i]);
    }
    found[i] = (sides[0] + sides[1]) / 2;
    size = sides[0] - sides[1];
    results_[kPositions[i]] = *found[i];
    results_[kErrors[i]] = *found[i] - start[i];
    Position middle = machine_.position();
    middle[i] = *found[i];
    if (!protectedTo(middle)) return false;
  }
  if (!protectedTo(start)) return false;
  results_[ir::ResultName::Size] = size;
  results_[ir::ResultName::SizeError] = size - *diameter;
  if (MotionWatcher* const watcher = this->watcher(); watcher != nullptr)
    watcher->measured(
        {0, "bore", {{"X", start[0], *found[0]}, {"Y", start[1], *found[1]}, {"diameter", *diameter, size}}});
  if (node.setting && !set(*node.setting, found)) return false;
  end();
  return true;
}

// The system gets the offset in force, and the difference of what was measured and what that gets.
bool CycleRun::set(const ir::OffsetSetting& setting, const std::array<std::optional<double>, 3>& measured) {
  const auto which = system(setting.system);
  if (!which) return false;
  std::array<std::optional<double>, 3> values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!setting.nominal[i] || !measured[i]) continue;
    const std::optional<double> nominal = number(setting.nominal[i]);
    if (!nominal) return false;
    values[i] = machine_.offsetOf(machine_.activeSystem(), i) + *measured[i] - *nominal;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] && !machine_.writeOffset(*which, i, *values[i])) return false;
  return true;
}

} // namespace dotek::sim
