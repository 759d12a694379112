#include "verify/Exactness.h"

#include "sim/geometry/Contact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dotek::verify {
namespace {

constexpr double kDegrees = 57.3;      // of a radian
constexpr double kBesideMiddle = 1e-4; // mm: half a step of the control, a fifth of the radius off
constexpr double kTurned =
    0.006; // a flat face leans at most so much from the touch that expects it: 0.3 degrees

// By how much what is computed from three touches that look from one middle is off, for an error of 1 of
// each: the circle's middle and radius x, y, r solve d.x * x + d.y * y + r = e. 1: of touches along the axes.
double spreadOf(const Measure& measure) {
  if (!isOblique(measure)) return 1;
  if (measure.nominal.size() != 3) return 2; // both coordinates of each contact count
  constexpr double kOnOneLine = 1e-3, kMost = 100;
  std::array<double, 3> x{}, y{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = measure.nominal[i].direction.x;
    y[i] = measure.nominal[i].direction.y;
  }
  const double determinant = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (std::abs(determinant) < kOnOneLine) return kMost;
  double ofX = 0, ofY = 0, ofR = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3, l = (i + 2) % 3;
    ofX += std::abs(y[k] - y[l]);
    ofY += std::abs(x[l] - x[k]);
    ofR += std::abs(x[k] * y[l] - x[l] * y[k]);
  }
  return std::clamp(std::max({ofX, ofY, 2 * ofR}) / std::abs(determinant), 1.0, kMost);
}

// How far apart two touches of one face are; 0: it is no such measure.
double baseOf(const Measure& measure) {
  constexpr double kSameWay = 1e-9;
  if (measure.nominal.size() != 2) return 0;
  const Touch &one = measure.nominal[0], &other = measure.nominal[1];
  if ((one.direction - other.direction).length() > kSameWay) return 0;
  const sim::Point3 way = other.point - one.point;
  return (way - one.direction * way.dot(one.direction)).length();
}

} // namespace

// A move that the stem or the body of the probe stops ends at a place that is known to the safe side alone,
// and with it what the source takes for measured.
CompareRules asExactAs(const Record& source, CompareRules rules) {
  const bool stopped = std::any_of(source.events.begin(), source.events.end(), [](const auto& event) {
    return event.first.outcome == sim::Outcome::StemCollision ||
           event.first.outcome == sim::Outcome::BodyCollision;
  });
  if (stopped) rules.results = std::max(rules.results, sim::kCollisionMargin);
  for (const Measure& measure : source.measures)
    if (const double base = baseOf(measure); base > 0)
      rules.angles = std::max(rules.angles, rules.results / base * kDegrees);
  // Another macro computes a circle from other places of the same control's grid.
  if (!rules.sameAlarmNumbers) {
    double spread = 1;
    for (const Measure& measure : source.measures) {
      spread = std::max(spread, spreadOf(measure));
      // A start by a rounded word, beside the middle of what is round.
      if (measure.nominal.size() > 2) rules.results = std::max(rules.results, kBesideMiddle);
      if (isOblique(measure) && measure.nominal.size() != 3)
        rules.results = std::max(rules.results, kObliqueWord * kTurned);
    }
    rules.results *= spread;
  }
  return rules;
}

} // namespace dotek::verify
