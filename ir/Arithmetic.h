// Arithmetic of doubles: the one evaluator behind folding, post and sim. Nothing throws; what has no finite
// result says why.
#pragma once

#include <cstdint>
#include <string_view>

namespace dotek::ir {

enum class ArithmeticError : std::uint8_t {
  None,
  DivisionByZero,
  Domain,   // square root of a negative number, arc sine of 2, direction of no length
  Overflow, // larger than a double holds
};

// `value` is finite where `error` is None, else 0.
struct Computed {
  double value = 0;
  ArithmeticError error = ArithmeticError::None;
  bool ok() const { return error == ArithmeticError::None; }
};

enum class AngleUnit : std::uint8_t { Degrees, Radians };

Computed add(double a, double b);
Computed subtract(double a, double b);
Computed multiply(double a, double b);
Computed divide(double a, double b);
Computed absolute(double a);
// Integer part, toward zero: -1.5 gives -1.
Computed truncate(double a);
Computed squareRoot(double a);
// Angles in `unit`. Multiples of 90 degrees give exact results.
Computed sine(double angle, AngleUnit unit);
Computed cosine(double angle, AngleUnit unit);
Computed tangent(double angle, AngleUnit unit);
Computed arcSine(double a, AngleUnit unit);
Computed arcCosine(double a, AngleUnit unit);
Computed arcTangent(double a, AngleUnit unit);
// Angle of the direction (x, y), above -180 up to 180 degrees; (0, 0) is a domain error.
Computed direction(double x, double y, AngleUnit unit);

// "a division by zero", ... for messages; "" for None.
std::string_view describe(ArithmeticError error);

} // namespace dotek::ir
