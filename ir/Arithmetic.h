// Arithmetic of doubles: the one evaluator after folding, post and sim. Nothing throws; what has no finite
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
  NoValue,  // an operand that nothing sets
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
// Away from zero: -1.2 gives -2.
Computed roundUp(double a);
// To the nearest integer, half away from zero.
Computed roundNearest(double a);
// Remainder of the division, with the sign of `a`.
Computed modulo(double a, double b);
Computed squareRoot(double a);
// Angles in `unit`. Multiples of 90 degrees give exact results.
Computed sine(double angle, AngleUnit unit);
Computed cosine(double angle, AngleUnit unit);
Computed tangent(double angle, AngleUnit unit);
Computed arcSine(double a, AngleUnit unit);
Computed arcCosine(double a, AngleUnit unit);
Computed arcTangent(double a, AngleUnit unit);
// Natural; of numbers above 0.
Computed logarithm(double a);
Computed exponential(double a);
// Of whole numbers of 32 bits, two's complement; anything else is a domain error.
Computed bitAnd(double a, double b);
Computed bitOr(double a, double b);
Computed bitXor(double a, double b);
// Angle of the direction (x, y), above -180 up to 180 degrees; (0, 0) is a domain error.
Computed direction(double x, double y, AngleUnit unit);

// Both operands are rounded to whole numbers first, half away from zero.
Computed roundedAnd(double a, double b);
Computed roundedOr(double a, double b);
Computed roundedXor(double a, double b);
Computed roundedModulo(double a, double b); // sign of `a`
Computed power(double a, double b);
// As direction, from 0 up to below 360 degrees.
Computed bearing(double x, double y);
// Eight BCD digits at most; another digit than 0 to 9, a number below 0 or a larger one: a domain error.
Computed fromBcd(double a);
Computed toBcd(double a);

// "a division by zero", ... for messages; "" for None.
std::string_view describe(ArithmeticError error);

} // namespace dotek::ir
