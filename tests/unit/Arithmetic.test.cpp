#include "ir/Arithmetic.h"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace dotek::ir;

TEST_CASE("arithmetic says why it has no result") {
  CHECK(add(1, 2).value == 3);
  CHECK(subtract(1, 2).value == -1);
  CHECK(multiply(-3, 2).value == -6);
  CHECK(divide(1, 4).value == 0.25);
  CHECK(divide(1, 0).error == ArithmeticError::DivisionByZero);
  CHECK(divide(0, -0.0).error == ArithmeticError::DivisionByZero);
  const double huge = std::numeric_limits<double>::max();
  CHECK(add(huge, huge).error == ArithmeticError::Overflow);
  CHECK(multiply(huge, -2).error == ArithmeticError::Overflow);
  CHECK_FALSE(std::signbit(multiply(0, -1).value));
  CHECK(absolute(-2).value == 2);
  CHECK(truncate(-1.5).value == -1);
  CHECK(truncate(1.9).value == 1);
  CHECK(squareRoot(9).value == 3);
  CHECK(squareRoot(-1).error == ArithmeticError::Domain);
}

TEST_CASE("angles") {
  constexpr auto kDeg = AngleUnit::Degrees;
  constexpr auto kRad = AngleUnit::Radians;
  CHECK(sine(180, kDeg).value == 0);
  CHECK(sine(-90, kDeg).value == -1);
  CHECK(cosine(450, kDeg).value == 0);
  CHECK(cosine(60, kDeg).value == doctest::Approx(0.5));
  CHECK(tangent(45, kDeg).value == doctest::Approx(1));
  CHECK(tangent(90, kDeg).error == ArithmeticError::Domain);
  CHECK(sine(1, kRad).value == doctest::Approx(0.841471));
  CHECK(arcSine(1, kDeg).value == doctest::Approx(90));
  CHECK(arcSine(1.01, kDeg).error == ArithmeticError::Domain);
  CHECK(arcCosine(0, kRad).value == doctest::Approx(1.570796));
  CHECK(arcTangent(-1, kDeg).value == doctest::Approx(-45));
  CHECK(direction(0, 2, kDeg).value == doctest::Approx(90));
  CHECK(direction(-1, -0.0, kDeg).value == doctest::Approx(180));
  CHECK(direction(0, 0, kDeg).error == ArithmeticError::Domain);
}
