#include "tests/unit/SlowValues.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace dotek::tests {
namespace {

constexpr double kPi = 3.14159265358979323846;

// The shortest decimal number that reads back as a double: 0.<digits> times ten to the power of `point`.
struct Written {
  bool negative = false;
  std::string digits;
  int point = 0;

  explicit Written(double value) {
    negative = value < 0;
    if (value == 0) return;
    char buffer[40];
    const auto end =
        std::to_chars(buffer, buffer + sizeof buffer, std::fabs(value), std::chars_format::scientific).ptr;
    const std::string text(buffer, end);
    const std::size_t exponent = text.find('e');
    for (const char c : text.substr(0, exponent))
      if (c != '.') digits += c;
    point = std::atoi(text.c_str() + exponent + 1) + 1;
    trim();
  }

  void trim() {
    while (!digits.empty() && digits.back() == '0')
      digits.pop_back();
    if (digits.empty()) negative = false;
  }
  // Keeps the first `count` digits, rounded half away from zero.
  void keep(int count) {
    if (count >= static_cast<int>(digits.size())) return;
    const bool up = count >= 0 && digits[static_cast<std::size_t>(count)] >= '5';
    digits.resize(static_cast<std::size_t>(std::max(count, 0)));
    if (up) {
      std::size_t at = digits.size();
      while (at > 0 && digits[at - 1] == '9')
        digits[--at] = '0';
      if (at > 0) {
        ++digits[at - 1];
      } else {
        digits.insert(digits.begin(), '1');
        ++point;
      }
    }
    trim();
  }
  double value() const {
    if (digits.empty()) return 0;
    return std::strtod(((negative ? "-0." : "0.") + digits + "e" + std::to_string(point)).c_str(), nullptr);
  }
};

bool isMultiple(double value, double of) {
  return std::fmod(value, of) == 0;
}

} // namespace

void raiseAlarm(int number) {
  throw SlowStop{SlowStop::Kind::Alarm, number, ""};
}
void leftOpen(const std::string& what) {
  throw SlowStop{SlowStop::Kind::Unsupported, 0, what};
}

// Marks the run where a doubtful value lies halfway between two multiples of `unit`.
void SlowArithmetic::tie(SlowValue value, double unit) {
  if (!value.doubtful) return;
  const double units = std::fabs(value.number) / unit;
  if (std::fabs(units - std::floor(units) - 0.5) < 1e-6 + 1e-10 * units) fragile_ = true;
}

void SlowArithmetic::near(SlowValue value, double place) {
  if (value.doubtful && std::fabs(value.number - place) <= 1e-9 * std::max(1.0, std::fabs(place)))
    fragile_ = true;
}

SlowValue SlowArithmetic::held(double number, bool doubtful) {
  if (!std::isfinite(number)) raiseAlarm(111);
  if (decimal8_ && number != 0) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::fabs(number))) - 7);
    if (unit > 0) tie({number, false, doubtful}, unit);
    Written text(number);
    text.keep(8);
    number = text.value();
    doubtful = false;
    if (std::fabs(number) < 1e-29 || std::fabs(number) > 1e47) raiseAlarm(111);
  }
  return {number + 0.0, false, doubtful}; // no -0
}

SlowValue SlowArithmetic::negated(SlowValue value) {
  return held(0 - value.number, value.doubtful);
}

double SlowArithmetic::whole(SlowValue value) {
  tie(value, 1);
  const double part = std::trunc(value.number);
  if (std::fabs(value.number - part) < 0.5) return part + 0.0;
  return part + (value.number < 0 ? -1 : 1);
}

double SlowArithmetic::thousandths(SlowValue value) {
  checkDecimals(value, 3);
  Written text(value.number);
  text.keep(text.point + 3);
  return text.value();
}

// Marks the run where a value lies so close to a tie that the last bit decides; an exact decimal tie does
// not.
void SlowArithmetic::checkDecimals(SlowValue value, int places) {
  const double unit = std::pow(10.0, -places);
  tie(value, unit);
  const Written text(value.number);
  if (text.point + places + 1 >= static_cast<int>(text.digits.size())) return;
  tie({value.number, false, true}, unit);
}

SlowValue SlowArithmetic::operate(const std::string& op, SlowValue left, SlowValue right) {
  const bool doubtful = left.doubtful || right.doubtful;
  const double a = left.number;
  const double b = right.number;
  if (op == "+") return held(a + b, doubtful);
  if (op == "-") return held(a - b, doubtful);
  if (op == "*") return held(a * b, doubtful);
  if (op == "/") {
    near(right, 0);
    if (b == 0) raiseAlarm(112);
    return held(a / b, doubtful);
  }
  if (op == "MOD") {
    const double dividend = whole(left);
    const double divisor = whole(right);
    if (divisor == 0) raiseAlarm(112);
    return held(std::fmod(dividend, divisor), false);
  }
  if (op == "AND" || op == "OR" || op == "XOR") return bits(op, left, right);
  leftOpen("operator " + op);
}

// Whole numbers of 32 bits, two's complement.
SlowValue SlowArithmetic::bits(const std::string& op, SlowValue left, SlowValue right) {
  const auto integer = [&](SlowValue value) {
    const double number = whole(value);
    if (number < -2147483648.0 || number > 2147483647.0) raiseAlarm(110);
    return static_cast<std::int32_t>(number);
  };
  const std::int32_t a = integer(left);
  const std::int32_t b = integer(right);
  return held(op == "AND" ? a & b : op == "OR" ? a | b : a ^ b, false);
}

bool SlowArithmetic::compare(const std::string& op, SlowValue left, SlowValue right) {
  if ((op == "EQ" || op == "NE") && (left.null || right.null))
    return (left.null && right.null) == (op == "EQ");
  const double a = left.number;
  const double b = right.number;
  if (left.doubtful || right.doubtful) near({a - b, false, true}, 0);
  if ((left.doubtful || right.doubtful) && std::fabs(a - b) <= 1e-9 * std::max(std::fabs(a), std::fabs(b)))
    fragile_ = true;
  if (op == "EQ") return a == b;
  if (op == "NE") return a != b;
  if (op == "GT") return a > b;
  if (op == "GE") return a >= b;
  if (op == "LT") return a < b;
  if (op == "LE") return a <= b;
  leftOpen("relation " + op);
}

// SIN, COS and TAN of degrees; multiples of 90 degrees are exact.
SlowValue SlowArithmetic::angle(const std::string& name, SlowValue value) {
  if (isMultiple(value.number, 90)) {
    static constexpr int kSine[] = {0, 1, 0, -1};
    const int quarter = (static_cast<int>(std::fmod(value.number, 360) / 90) + 4) % 4;
    const int sine = kSine[quarter];
    const int cosine = kSine[(quarter + 1) % 4];
    if (name == "SIN") return held(sine, value.doubtful);
    if (name == "COS") return held(cosine, value.doubtful);
    near({0, false, value.doubtful}, 0);
    if (cosine == 0) raiseAlarm(112);
    return held(0, value.doubtful);
  }
  const double radians = value.number * kPi / 180;
  if (name == "SIN") return held(std::sin(radians), true);
  if (name == "COS") return held(std::cos(radians), true);
  near({std::remainder(value.number, 90), false, value.doubtful}, 0);
  return held(std::tan(radians), true);
}

// BIN and BCD: eight decimal digits, four bits each.
SlowValue SlowArithmetic::coded(const std::string& name, SlowValue value) {
  const double number = whole(value);
  const double from = name == "BIN" ? 16 : 10;
  const double to = name == "BIN" ? 10 : 16;
  if (number < 0 || number >= std::pow(from, 8)) raiseAlarm(119);
  double rest = number;
  double scale = 1;
  double out = 0;
  while (rest > 0) {
    const double digit = std::fmod(rest, from);
    if (digit > 9) raiseAlarm(119);
    out += digit * scale;
    scale *= to;
    rest = std::floor(rest / from);
  }
  return held(out, false);
}

SlowValue SlowArithmetic::twoArguments(const std::string& name, SlowValue first, SlowValue second) {
  if (name == "ATAN") {
    if (first.number == 0 && second.number == 0) leftOpen("ATAN[0]/[0]");
    near(first, 0);
    const double degrees = std::atan2(first.number, second.number) * 180 / kPi;
    return held(degrees < 0 ? degrees + 360 : degrees, true);
  }
  if (name != "POW") leftOpen(name + " with two arguments");
  if (first.number == 0 && second.number <= 0) leftOpen("POW of 0");
  near(first, 0);
  if (first.number < 0 && second.doubtful) fragile_ = true;
  if (first.number < 0 && !isMultiple(second.number, 1)) raiseAlarm(119);
  return held(std::pow(first.number, second.number), true);
}

SlowValue SlowArithmetic::apply(const std::string& name, const std::vector<SlowValue>& arguments,
                                double unit) {
  if (arguments.size() == 2) return twoArguments(name, arguments[0], arguments[1]);
  const SlowValue value = arguments.front();
  const double x = value.number;
  if (name == "SIN" || name == "COS" || name == "TAN") return angle(name, value);
  if (name == "ASIN" || name == "ACOS") {
    near(value, 1);
    near(value, -1);
    if (std::fabs(x) > 1) raiseAlarm(119);
    return held((name == "ASIN" ? std::asin(x) : std::acos(x)) * 180 / kPi, true);
  }
  if (name == "ATAN") return held(std::atan(x) * 180 / kPi, true);
  if (name == "SQRT") {
    near(value, 0);
    if (x < 0) raiseAlarm(119);
    return held(std::sqrt(x), value.doubtful);
  }
  if (name == "ABS") return held(std::fabs(x), value.doubtful);
  if (name == "ROUND" && unit == 1) return held(whole(value), false);
  if (name == "ROUND" && unit == 0.001) return held(thousandths(value), false);
  if (name == "FIX" || name == "FUP") {
    near(value, std::round(x));
    return held(name == "FIX" || std::trunc(x) == x ? std::trunc(x) : std::trunc(x) + (x < 0 ? -1 : 1),
                false);
  }
  if (name == "LN") {
    near(value, 0);
    if (x <= 0) raiseAlarm(119);
    return held(std::log(x), true);
  }
  if (name == "EXP") return held(std::exp(x), true);
  if (name == "BIN" || name == "BCD") return coded(name, value);
  leftOpen(name);
}

std::string SlowArithmetic::printed(SlowValue value, int integerDigits, int decimals) {
  checkDecimals(value, decimals);
  Written text(value.number);
  text.keep(text.point + decimals);
  std::string digits = text.digits;
  // Zeros up to the point on both sides.
  if (text.point < 0) digits.insert(0, static_cast<std::size_t>(-text.point), '0');
  const auto before = static_cast<std::size_t>(std::max(text.digits.empty() ? 0 : text.point, 0));
  if (digits.size() < before) digits.append(before - digits.size(), '0');
  std::string integer = digits.substr(0, before);
  std::string fraction = digits.substr(before);
  fraction.resize(static_cast<std::size_t>(decimals), '0');
  if (integer.empty()) integer = "0";
  const auto width = static_cast<std::size_t>(integerDigits);
  const std::string pad(integer.size() < width ? width - integer.size() : 0, ' ');
  integer.insert(0, pad + (text.negative ? "-" : ""));
  return decimals == 0 ? integer : integer + "." + fraction;
}

} // namespace dotek::tests
