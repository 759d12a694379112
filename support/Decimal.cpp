#include "support/Decimal.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace dotek {
namespace {

void trim(Decimal& d) {
  while (d.digits.ends_with('0'))
    d.digits.pop_back();
  const std::size_t leading = std::min(d.digits.find_first_not_of('0'), d.digits.size());
  d.digits.erase(0, leading);
  d.point -= static_cast<int>(leading);
  if (d.digits.empty()) d = Decimal{};
}

} // namespace

Decimal Decimal::of(double value) {
  Decimal d;
  if (value == 0.0) return d;
  d.negative = value < 0;
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, std::fabs(value), std::chars_format::scientific).ptr;
  const std::string_view text(buffer, static_cast<std::size_t>(end - buffer));
  const std::size_t e = text.find('e');
  for (const char c : text.substr(0, e)) {
    if (c != '.') d.digits += c;
  }
  d.point = std::atoi(std::string(text.substr(e + 1)).c_str()) + 1;
  trim(d);
  return d;
}

double Decimal::value() const {
  if (isZero()) return 0.0;
  const std::string text = "0." + digits + "e" + std::to_string(point);
  double result = 0; // from_chars, unlike strtod, does not follow the locale
  std::from_chars(text.data(), text.data() + text.size(), result);
  return negative ? -result : result;
}

std::string Decimal::integerPart() const {
  if (point <= 0) return "";
  const auto count = static_cast<std::size_t>(point);
  std::string out = digits.substr(0, count);
  out.resize(count, '0');
  return isZero() ? "" : out;
}

std::string Decimal::fractionPart() const {
  if (isZero()) return "";
  if (point <= 0) return std::string(static_cast<std::size_t>(-point), '0') + digits;
  return static_cast<std::size_t>(point) < digits.size() ? digits.substr(static_cast<std::size_t>(point))
                                                         : "";
}

Decimal Decimal::rounded(int places) const {
  Decimal d = *this;
  const int keep = d.point + places; // digits that stay
  if (keep >= static_cast<int>(d.digits.size())) return d;
  if (keep < 0) return {};
  const auto count = static_cast<std::size_t>(keep);
  const bool up = d.digits[count] >= '5';
  d.digits.resize(count);
  if (up) {
    std::size_t i = count;
    while (i > 0 && d.digits[i - 1] == '9')
      d.digits[--i] = '0';
    if (i > 0) {
      ++d.digits[i - 1];
    } else {
      d.digits.insert(d.digits.begin(), '1');
      ++d.point;
    }
  }
  trim(d);
  return d;
}

std::string numberText(double value) {
  const Decimal d = Decimal::of(value);
  std::string out = d.negative ? "-" : "";
  const std::string whole = d.integerPart();
  const std::string fraction = d.fractionPart();
  out += whole.empty() ? "0" : whole;
  if (!fraction.empty()) out += "." + fraction;
  return out;
}

std::string fixedText(double value, int places) {
  const Decimal d = Decimal::of(value).rounded(places);
  std::string fraction = d.fractionPart();
  fraction.resize(static_cast<std::size_t>(places), '0');
  const std::string whole = d.integerPart();
  return (d.negative ? "-" : "") + (whole.empty() ? "0" : whole) + (places > 0 ? "." + fraction : "");
}

std::optional<double> parseNumber(std::string_view text) {
  std::string_view body = text;
  if (body.starts_with('-') || body.starts_with('+')) body.remove_prefix(1);
  const std::size_t digits = static_cast<std::size_t>(
      std::count_if(body.begin(), body.end(), [](char c) { return c >= '0' && c <= '9'; }));
  const std::size_t points = static_cast<std::size_t>(std::count(body.begin(), body.end(), '.'));
  if (digits == 0 || points > 1 || digits + points != body.size()) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(body.data(), body.data() + body.size(), value);
  if (error != std::errc() || end != body.data() + body.size() || !std::isfinite(value)) return std::nullopt;
  return text.starts_with('-') && value != 0.0 ? -value : value;
}

} // namespace dotek
