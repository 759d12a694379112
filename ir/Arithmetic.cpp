#include "ir/Arithmetic.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace dotek::ir {
namespace {

Computed finite(double value) {
  if (!std::isfinite(value)) return {0, ArithmeticError::Overflow};
  return {value == 0 ? 0.0 : value, ArithmeticError::None}; // no -0
}

Computed domain() {
  return {0, ArithmeticError::Domain};
}

template <class Operation> Computed bits(double a, double b, Operation operation) {
  const auto whole = [](double value) {
    return value == std::trunc(value) && value >= std::numeric_limits<std::int32_t>::min() &&
           value <= std::numeric_limits<std::int32_t>::max();
  };
  if (!whole(a) || !whole(b)) return domain();
  return finite(operation(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)));
}

double toRadians(double angle, AngleUnit unit) {
  return unit == AngleUnit::Degrees ? angle * std::numbers::pi / 180.0 : angle;
}

Computed fromRadians(double angle, AngleUnit unit) {
  return finite(unit == AngleUnit::Degrees ? angle * 180.0 / std::numbers::pi : angle);
}

// Quarter turns 0..3 where a degree angle is a multiple of 90, else -1.
int quarterTurns(double angle, AngleUnit unit) {
  if (unit != AngleUnit::Degrees) return -1;
  // The quotient of a multiple is exact: any other is none, and needs no remainder.
  if (const double quotient = angle / 90.0; quotient != std::floor(quotient)) return -1;
  const double rest = std::fmod(angle, 360.0);
  const double quarters = (rest < 0 ? rest + 360.0 : rest) / 90.0;
  return quarters == std::floor(quarters) ? static_cast<int>(quarters) % 4 : -1;
}

} // namespace

Computed add(double a, double b) {
  return finite(a + b);
}

Computed subtract(double a, double b) {
  return finite(a - b);
}

Computed multiply(double a, double b) {
  return finite(a * b);
}

Computed divide(double a, double b) {
  if (b == 0) return {0, ArithmeticError::DivisionByZero};
  return finite(a / b);
}

Computed absolute(double a) {
  return finite(std::fabs(a));
}

Computed truncate(double a) {
  return finite(std::trunc(a));
}

Computed roundUp(double a) {
  return finite(a < 0 ? std::floor(a) : std::ceil(a));
}

Computed roundNearest(double a) {
  return finite(std::round(a));
}

Computed modulo(double a, double b) {
  if (b == 0) return {0, ArithmeticError::DivisionByZero};
  return finite(std::fmod(a, b));
}

Computed logarithm(double a) {
  return a > 0 ? finite(std::log(a)) : domain();
}

Computed exponential(double a) {
  return finite(std::exp(a));
}

Computed bitAnd(double a, double b) {
  return bits(a, b, [](std::int32_t x, std::int32_t y) { return x & y; });
}

Computed bitOr(double a, double b) {
  return bits(a, b, [](std::int32_t x, std::int32_t y) { return x | y; });
}

Computed bitXor(double a, double b) {
  return bits(a, b, [](std::int32_t x, std::int32_t y) { return x ^ y; });
}

Computed squareRoot(double a) {
  return a < 0 ? domain() : finite(std::sqrt(a));
}

Computed sine(double angle, AngleUnit unit) {
  constexpr double kExact[] = {0, 1, 0, -1};
  const int quarters = quarterTurns(angle, unit);
  return finite(quarters >= 0 ? kExact[quarters] : std::sin(toRadians(angle, unit)));
}

Computed cosine(double angle, AngleUnit unit) {
  constexpr double kExact[] = {1, 0, -1, 0};
  const int quarters = quarterTurns(angle, unit);
  return finite(quarters >= 0 ? kExact[quarters] : std::cos(toRadians(angle, unit)));
}

Computed tangent(double angle, AngleUnit unit) {
  const int quarters = quarterTurns(angle, unit);
  if (quarters == 1 || quarters == 3) return domain();
  return finite(quarters >= 0 ? 0.0 : std::tan(toRadians(angle, unit)));
}

Computed arcSine(double a, AngleUnit unit) {
  return std::fabs(a) > 1 ? domain() : fromRadians(std::asin(a), unit);
}

Computed arcCosine(double a, AngleUnit unit) {
  return std::fabs(a) > 1 ? domain() : fromRadians(std::acos(a), unit);
}

Computed arcTangent(double a, AngleUnit unit) {
  return fromRadians(std::atan(a), unit);
}

Computed direction(double x, double y, AngleUnit unit) {
  if (x == 0 && y == 0) return domain();
  return fromRadians(std::atan2(y == 0 ? 0.0 : y, x), unit);
}

Computed roundedAnd(double a, double b) {
  return bitAnd(std::round(a), std::round(b));
}

Computed roundedOr(double a, double b) {
  return bitOr(std::round(a), std::round(b));
}

Computed roundedXor(double a, double b) {
  return bitXor(std::round(a), std::round(b));
}

Computed roundedModulo(double a, double b) {
  return modulo(std::round(a), std::round(b));
}

Computed power(double a, double b) {
  if (a == 0 && b < 0) return {0, ArithmeticError::DivisionByZero};
  if (a < 0 && b != std::trunc(b)) return domain();
  return finite(std::pow(a, b));
}

Computed bearing(double x, double y) {
  Computed out = direction(x, y, AngleUnit::Degrees);
  if (out.ok() && out.value < 0) out.value += 360;
  if (out.value >= 360) out.value = 0; // a tiny negative angle
  return out;
}

Computed fromBcd(double a) {
  const double whole = std::round(a);
  if (!(whole >= 0 && whole <= 0xFFFFFFFF)) return domain();
  double out = 0, place = 1;
  for (auto rest = static_cast<std::uint32_t>(whole); rest != 0; rest >>= 4U, place *= 10) {
    if ((rest & 15U) > 9) return domain();
    out += (rest & 15U) * place;
  }
  return finite(out);
}

Computed toBcd(double a) {
  const double whole = std::round(a);
  if (!(whole >= 0 && whole <= 99999999)) return domain();
  std::uint32_t out = 0;
  unsigned shift = 0;
  for (auto rest = static_cast<std::uint32_t>(whole); rest != 0; rest /= 10, shift += 4)
    out |= rest % 10 << shift;
  return finite(out);
}

std::string_view describe(ArithmeticError error) {
  switch (error) {
  case ArithmeticError::None: return "";
  case ArithmeticError::DivisionByZero: return "a division by zero";
  case ArithmeticError::Domain: return "a value that the function has no result for";
  case ArithmeticError::Overflow: return "a result that is too large";
  case ArithmeticError::NoValue: return "arithmetic with a value that nothing sets";
  }
  return "";
}

} // namespace dotek::ir
