#include "support/Picture.h"

#include <algorithm>
#include <charconv>
#include <vector>

namespace dotek {
namespace {

bool isPlaceholder(char c) {
  return c == '#' || c == '0';
}
bool isPointSign(char c) {
  return c == '.' || c == '^';
}

PictureError error(std::size_t offset, std::size_t length, std::string message) {
  return {static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(length), std::move(message)};
}

// Bytes of the UTF-8 character at `at`, 1 in another encoding.
std::size_t characterLength(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 1;
  if (at + length > text.size()) return 1;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[at + i]) & 0xC0) != 0x80) return 1;
  }
  return length;
}

// digits += amount, digits being a whole number without sign.
void add(std::string& digits, std::int64_t amount) {
  std::int64_t carry = amount;
  for (std::size_t i = digits.size(); i-- > 0 && carry != 0;) {
    const std::int64_t sum = (digits[i] - '0') + carry;
    std::int64_t digit = sum % 10;
    if (digit < 0) digit += 10;
    carry = (sum - digit) / 10;
    digits[i] = static_cast<char>('0' + digit);
  }
  for (; carry > 0; carry /= 10)
    digits.insert(digits.begin(), static_cast<char>('0' + carry % 10));
}

// Nearest multiple of `step` units of the last place, half away from zero; exact for any size.
Decimal roundedToStep(const Decimal& value, int places, std::uint32_t step) {
  Decimal units = value;
  units.point += places;
  std::string whole = units.integerPart();
  const std::string fraction = units.fractionPart();
  std::uint64_t remainder = 0;
  for (const char c : whole)
    remainder = (remainder * 10 + static_cast<std::uint64_t>(c - '0')) % step;
  const bool halfBehind = !fraction.empty() && fraction[0] >= '5';
  const bool up = 2 * remainder >= step || (2 * remainder + 1 == step && halfBehind);
  add(whole, (up ? static_cast<std::int64_t>(step) : 0) - static_cast<std::int64_t>(remainder));

  Decimal result;
  const std::size_t first = whole.find_first_not_of('0');
  if (first == std::string::npos) return result;
  result.negative = value.negative;
  result.digits = whole.substr(first, whole.find_last_not_of('0') + 1 - first);
  result.point = static_cast<int>(whole.size() - first) - places;
  return result;
}

} // namespace

std::variant<Picture, PictureError> Picture::parse(std::string_view text) {
  Picture picture;
  picture.text_ = text;

  std::vector<std::string_view> parts;
  std::vector<std::size_t> starts;
  for (std::size_t at = 0;;) {
    const std::size_t end = std::min(text.find(';', at), text.size());
    starts.push_back(at);
    parts.push_back(text.substr(at, end - at));
    if (end == text.size()) break;
    at = end + 1;
    if (parts.size() == 3) return error(end, 1, "a third `;`: a picture is body, zero text and step");
  }

  const std::string_view body = parts[0];
  std::size_t first = std::min(body.find_first_of("#0"), body.size());
  if (first == body.size())
    return error(0, std::max<std::size_t>(body.size(), 1), "a picture without any digit place `#` or `0`");
  if (first > 0 && isPointSign(body[first - 1])) --first;
  picture.prefix_ = body.substr(0, first);
  if (isPointSign(body[first]) && first > 0 && isPointSign(body[first - 1]))
    return error(first, 1, "a second point sign");

  for (std::size_t i = first; i < body.size(); ++i) {
    const char c = body[i];
    if (isPointSign(c)) {
      if (picture.point_ != Point::None) return error(i, 1, "a second point sign");
      picture.point_ = c == '.' ? Point::Printed : Point::Implied;
    } else if (isPlaceholder(c)) {
      (picture.point_ == Point::None ? picture.integer_ : picture.fraction_) += c;
    } else {
      const std::size_t length = characterLength(body, i);
      return error(i, length, "a character that is no digit place and no point inside the picture");
    }
  }

  if (parts.size() > 1) {
    if (parts[1].empty())
      return error(starts[1] - 1, 1, "nothing follows the `;`: the text for 0 is missing; write `;0`");
    picture.hasZero_ = true;
    picture.zero_ = parts[1];
  }
  if (parts.size() > 2) {
    const std::string_view step = parts[2];
    if (step.empty())
      return error(starts[2] - 1, 1, "nothing follows the second `;`: the rounding step is missing");
    const auto [end, failure] = std::from_chars(step.data(), step.data() + step.size(), picture.step_);
    if (failure != std::errc() || end != step.data() + step.size() || picture.step_ == 0)
      return error(starts[2], step.size(), "the rounding step is no whole number above 0");
  }
  return picture;
}

Picture::Printed Picture::print(double value) const {
  const Decimal exact = Decimal::of(value);
  Printed printed;
  printed.value = step_ == 1 ? exact.rounded(decimals()) : roundedToStep(exact, decimals(), step_);
  const Decimal& rounded = printed.value;
  std::string whole = rounded.integerPart();
  if (whole.size() > integer_.size()) {
    printed.fit = Fit::DoesNotFit;
    return printed;
  }
  if (rounded != exact) printed.fit = Fit::LosesDecimals;
  if (rounded.isZero() && (hasZero_ || zeroPrintsNothing())) {
    printed.text = zero_;
    return printed;
  }

  const std::size_t leftmost = integer_.find('0');
  const std::size_t wanted = leftmost == std::string::npos ? 0 : integer_.size() - leftmost;
  if (whole.size() < wanted) whole.insert(0, wanted - whole.size(), '0');

  std::string fraction = rounded.fractionPart();
  const std::size_t rightmost = fraction_.rfind('0');
  const std::size_t kept = rightmost == std::string::npos ? 0 : rightmost + 1;
  if (fraction.size() < kept) fraction.resize(kept, '0');
  if (point_ == Point::Implied && whole.empty()) {
    const std::size_t from = std::min(fraction_.find('0'), fraction.size());
    fraction.erase(0, std::min(fraction.find_first_not_of('0'), from));
  }
  printed.text = (rounded.negative ? "-" : "") + whole + (printsPoint() ? "." : "") + fraction;
  return printed;
}

bool Picture::zeroPrintsNothing() const {
  return !hasZero_ && integer_.find('0') == std::string::npos && fraction_.find('0') == std::string::npos;
}

} // namespace dotek
