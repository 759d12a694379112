#include "sim/machine/Rotation.h"

#include "ir/Arithmetic.h"
#include "sim/machine/Axes.h"

#include <limits>

namespace dotek::sim {

Rotation Rotation::about(std::size_t first, std::size_t second, const std::array<double, 2>& centre,
                         double degrees, const Position& at) {
  Rotation out;
  out.on_ = true;
  out.first_ = first;
  out.second_ = second;
  out.centre_ = centre;
  out.degrees_ = degrees;
  out.sine_ = ir::sine(degrees, ir::AngleUnit::Degrees).value;
  out.cosine_ = ir::cosine(degrees, ir::AngleUnit::Degrees).value;
  out.told_ = {at[first], at[second]};
  return out;
}

std::array<double, 2> Rotation::turnedWay(double first, double second) const {
  return {first * cosine_ - second * sine_, first * sine_ + second * cosine_};
}

Position Rotation::turned(Position program) const {
  if (!on_) return program;
  const std::array<double, 2> way = turnedWay(program[first_] - centre_[0], program[second_] - centre_[1]);
  program[first_] = snap(centre_[0] + way[0]);
  program[second_] = snap(centre_[1] + way[1]);
  return program;
}

Position Rotation::turnedBack(Position work) const {
  if (!on_) return work;
  const double first = work[first_] - centre_[0], second = work[second_] - centre_[1];
  work[first_] = snap(centre_[0] + first * cosine_ + second * sine_);
  work[second_] = snap(centre_[1] - first * sine_ + second * cosine_);
  return work;
}

void Rotation::forget() {
  told_.fill(std::numeric_limits<double>::quiet_NaN());
}

} // namespace dotek::sim
