#include "sim/machine/Decimal8.h"

#include "support/Decimal.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace dotek::sim {
namespace {

// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> kPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                            1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                            1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

double slowly(double value) {
  Decimal decimal = Decimal::of(value);
  if (decimal.digits.size() <= 8) return value;
  const bool up = decimal.digits[8] >= '5';
  decimal.digits.resize(8);
  if (up) {
    std::size_t i = 8;
    while (i > 0 && decimal.digits[i - 1] == '9')
      --i;
    decimal.digits.resize(i);
    if (i > 0) {
      ++decimal.digits[i - 1];
    } else {
      decimal.digits = "1";
      ++decimal.point;
    }
  }
  while (!decimal.digits.empty() && decimal.digits.back() == '0')
    decimal.digits.pop_back();
  return decimal.value();
}

} // namespace

double toDecimal8(double value) {
  const double size = std::abs(value);
  if (size == 0 || !std::isfinite(value)) return value + 0.0;
  if (size < 1e8 && size == std::floor(size)) return value;
  if (!(size >= 1e-14 && size < 1e22)) return slowly(value);
  // size * 10^shift has eight digits before the point.
  // The power of two gives the power of ten, or the one below it.
  const int power = static_cast<int>(std::bit_cast<std::uint64_t>(size) >> 52) - 1023;
  int shift = 7 - (power * 78913 >> 18);
  const auto scaledBy = [&](int by) {
    return by >= 0 ? size * kPowers[static_cast<std::size_t>(by)]
                   : size / kPowers[static_cast<std::size_t>(-by)];
  };
  double scaled = scaledBy(shift);
  if (scaled >= 1e8) scaled = scaledBy(--shift);
  if (scaled < 1e7) scaled = scaledBy(++shift);
  const double whole = std::floor(scaled);
  // Near a half the decimal text decides.
  if (std::abs(scaled - whole - 0.5) < 1e-6) return slowly(value);
  const double digits = scaled - whole > 0.5 ? whole + 1 : whole;
  const double out = shift >= 0 ? digits / kPowers[static_cast<std::size_t>(shift)]
                                : digits * kPowers[static_cast<std::size_t>(-shift)];
  return std::copysign(out, value);
}

bool fitsDecimal8(double value) {
  const double size = std::abs(value);
  return size == 0 || (size >= 1e-29 && size <= 1e47);
}

} // namespace dotek::sim
