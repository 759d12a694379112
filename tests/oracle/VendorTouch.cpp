// Touching: where the ball's centre is at the contact, and how the probe gets there.
#include "sim/machine/Paths.h"
#include "tests/oracle/VendorRun.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::oracle {

using namespace dotek::sim;

namespace {

Direction opposite(const Direction& direction) {
  return {-direction[0], -direction[1], -direction[2]};
}

} // namespace

// The radii that the macros count with: as calibrated, else as told, else 0.
bool VendorRun::findStylus() {
  const stdlib::ProbingFacts& facts = set_.probing;
  bool ok = true;
  const auto read = [&](std::optional<std::uint32_t> variable) -> std::optional<double> {
    if (!variable || !ok) return std::nullopt;
    const std::optional<double> out = machine_.read(*variable);
    ok = out.has_value();
    return ok && !isNull(*out) ? out : std::nullopt;
  };
  const std::optional<double> x = read(facts.radiusX), y = read(facts.radiusY);
  if (!ok) return false;
  if (x.has_value() != y.has_value()) {
    const std::uint32_t empty = x ? *facts.radiusY : *facts.radiusX,
                        set = x ? *facts.radiusX : *facts.radiusY;
    return notKnown(
        fmt::format("of the two calibrated radii #{} is empty, and #{} is not; the macros keep the "
                    "calibration of the stylus there, and a program that stores something else in "
                    "one of them spoils it",
                    empty, set));
  }
  for (const auto& offset : {read(facts.offsetX), read(facts.offsetY)})
    if (offset && *offset != 0)
      return notKnown("which way the calibrated offset of the ball counts is in no source");
  for (std::uint32_t i = facts.vectorFirst.value_or(1); ok && i <= facts.vectorLast.value_or(0); ++i)
    vectors_ = read(i).has_value() || vectors_;
  if (!ok) return false;
  if (!x && !memory_.stylusRadius) sayOnce("stylus", "not calibrated: radius 0");
  radiusX_ = x.value_or(memory_.stylusRadius.value_or(0));
  radiusY_ = y.value_or(memory_.stylusRadius.value_or(0));
  if (radiusX_ < 0 || radiusY_ < 0) {
    const auto variable = radiusX_ < 0 ? facts.radiusX : facts.radiusY;
    return notKnown(variable && (radiusX_ < 0 ? x : y)
                        ? fmt::format("the calibrated radius in #{} is below 0; a program that stores "
                                      "something else there spoils the calibration of the stylus",
                                      *variable)
                        : "a calibrated radius is below 0");
  }
  return true;
}

bool VendorRun::radius(const Direction& direction, double& out) {
  if (direction[2] != 0) {
    // Along Z the length of the tool says where the ball ends.
    out = set_.probing.lengthToTip ? 0 : radiusX_;
    return true;
  }
  const bool oblique = direction[0] != 0 && direction[1] != 0;
  if (oblique && (vectors_ || radiusX_ != radiusY_))
    return notKnown("how the calibrated radii count in an oblique direction is in no source");
  out = direction[0] != 0 ? radiusX_ : radiusY_;
  return true;
}

double VendorRun::overtravel(const Direction& direction) const {
  if (const auto given = value(Role::Overtravel)) return *given;
  const stdlib::ProbingFacts& facts = set_.probing;
  return direction[2] != 0 && facts.overtravelZ ? *facts.overtravelZ : facts.overtravel.value_or(0);
}

bool VendorRun::touch(const Direction& direction, double expected, Position& centre, bool plain) {
  double ball = 0;
  if (!radius(direction, ball)) return false;
  const bool known = argument(Role::Overtravel) != nullptr || set_.probing.overtravel;
  if (!plain && !known) return notKnown("how far beyond the expected surface it probes is in no source");
  const double travel = plain ? expected : expected - ball + overtravel(direction);
  if (!(travel > kNoPath)) return meaningless("the expected surface does not lie ahead of the probe");
  const Position from = machine_.position();
  const Position end = along(from, direction, travel);
  for (int pass = 0; pass < 2; ++pass) { // a fast touch and a slow one
    const bool mayMiss = value(Role::FlagOnly).value_or(0) == 1;
    const std::optional<bool> contact = machine_.probeTo(end, mayMiss);
    if (!contact) return false;
    missed_ = !*contact;
    if (missed_) return mayMiss ? machine_.travelTo(from) : alarm(stdlib::MacroAlarm::ProbeFail);
    centre = machine_.position();
    if (distance(from, centre) < kNoPath) return alarm(stdlib::MacroAlarm::ProbeOpen);
    if (!machine_.travelTo(from)) return false;
  }
  return true;
}

bool VendorRun::watched(const Position& end) {
  if (distance(machine_.position(), end) < kNoPath) return true;
  const std::optional<bool> contact = machine_.probeTo(end, true);
  if (!contact) return false;
  return !*contact || alarm(stdlib::MacroAlarm::PathObstructed);
}

// Z makes it a touch from outside, R below 0 one from inside beyond an island.
bool VendorRun::findSides() {
  const auto depth = value(Role::Depth);
  if (!depth) return true;
  down_ = true;
  depth_ = *depth;
  const auto clearance =
      argument(Role::Clearance) != nullptr ? value(Role::Clearance) : set_.probing.clearance;
  if (!clearance) return notKnown("how far it keeps away from the surface without R is in no source");
  if (*clearance == 0) return meaningless("what R0 means is in no source", 'R');
  outside_ = *clearance > 0;
  beside_ = std::abs(*clearance);
  return true;
}

bool VendorRun::touchSide(const Position& middle, const Direction& direction, double half, Position& centre) {
  if (!down_) return touch(direction, half, centre);
  double ball = 0;
  if (!radius(direction, ball)) return false;
  const double out = outside_ ? half + beside_ + ball : half - beside_ - ball;
  if (out < 0) return meaningless("the clearance is larger than the feature");
  const Position above = along(middle, direction, out);
  Position below = above;
  below[2] = depth_;
  return watched(above) && watched(below) &&
         touch(outside_ ? opposite(direction) : direction, beside_ + ball, centre) &&
         machine_.travelTo(above) && machine_.travelTo(middle);
}

bool VendorRun::touchPair(const Position& middle, const Direction& direction, double width, double& offset,
                          double& size) {
  if (!(width > 0)) return meaningless("a size that is not above 0");
  Position plus, minus;
  if (!touchSide(middle, direction, width / 2, plus) ||
      !touchSide(middle, opposite(direction), width / 2, minus))
    return false;
  double ball = 0;
  if (!radius(direction, ball)) return false;
  const auto at = [&](const Position& point) {
    double out = 0;
    for (std::size_t i = 0; i < direction.size(); ++i)
      out += (point[i] - middle[i]) * direction[i];
    return out;
  };
  offset = (at(plus) + at(minus)) / 2;
  size = at(plus) - at(minus) + (outside_ ? -2 : 2) * ball;
  return true;
}

} // namespace dotek::oracle
