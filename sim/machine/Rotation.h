// G68: the coordinates of a program turned about a point of the active work system, within one plane.
#pragma once

#include "sim/machine/Trace.h"

#include <array>
#include <cstddef>

namespace dotek::sim {

class Rotation {
public:
  // Counterclockwise by `degrees` from axis `first` to axis `second`, about a point in coordinates of the
  // work system. `at`: where the machine is, in the same coordinates.
  static Rotation about(std::size_t first, std::size_t second, const std::array<double, 2>& centre,
                        double degrees, const Position& at);

  bool on() const { return on_; }
  bool turns(std::size_t axis) const { return on_ && (axis == first_ || axis == second_); }
  double degrees() const { return degrees_; }
  std::size_t first() const { return first_; }
  std::size_t second() const { return second_; }
  std::size_t other(std::size_t axis) const { return axis == first_ ? second_ : first_; }

  // From coordinates of the program to those of the work system, and back. Other axes stay.
  Position turned(Position program) const;
  Position turnedBack(Position work) const;
  // A distance along the two axes.
  std::array<double, 2> turnedWay(double first, double second) const;

  // What the program has said of an axis since G68: the position in coordinates of the program on a control
  // that takes the position before G68 as it was. NaN: nothing that holds.
  double told(std::size_t axis) const { return told_[axis == first_ ? 0 : 1]; }
  void tell(std::size_t axis, double value) { told_[axis == first_ ? 0 : 1] = value; }
  // The machine was moved in its own coordinates.
  void forget();

private:
  bool on_ = false;
  std::size_t first_ = 0, second_ = 1;
  double degrees_ = 0, sine_ = 0, cosine_ = 1;
  std::array<double, 2> centre_{}, told_{};
};

} // namespace dotek::sim
