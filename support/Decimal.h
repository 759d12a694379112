// Decimal view of a double: the one place that rounds and prints numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dotek {

// Value = 0.d1d2d3... * 10^point with digits d; zero has no digits. Made from the shortest decimal text
// that reads back as the same double.
struct Decimal {
  bool negative = false;
  std::string digits; // no leading and no trailing zero
  int point = 0;      // decimal places that `digits` is shifted left; may be negative

  // `value` is finite.
  static Decimal of(double value);
  bool isZero() const { return digits.empty(); }
  double value() const;
  // Digits before the point, without leading zeros ("" for values below 1).
  std::string integerPart() const;
  // Digits after the point, without trailing zeros.
  std::string fractionPart() const;
  // Half away from zero, to `places` >= 0 digits after the point. Zero is never negative.
  Decimal rounded(int places) const;
  bool operator==(const Decimal&) const = default;
};

// Shortest text that reads back as `value`, without exponent and without "-0": 5, -0.25, 120.
std::string numberText(double value);
// Fixed point with exactly `places` decimals, half away from zero, no "-0".
std::string fixedText(double value, int places);
// A decimal number such as -5, 0.25, .5, 5. ; nothing else (no exponent, no blanks, no infinity).
std::optional<double> parseNumber(std::string_view text);

} // namespace dotek
