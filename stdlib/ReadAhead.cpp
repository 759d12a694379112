#include "stdlib/ReadAhead.h"

#include <algorithm>
#include <cmath>

namespace dotek::stdlib {
namespace {

constexpr double kLimitCode = 103;

bool lists(const Control& control, char letter, double code) {
  const double tenths = std::round(code * 10);
  return tenths >= 0 && tenths < 1e9 &&
         std::binary_search(control.readAheadStops.begin(), control.readAheadStops.end(),
                            std::pair(letter, static_cast<std::uint32_t>(tenths)));
}

} // namespace

bool stopsReadingAhead(const Control& control, char letter, double code) {
  return !(letter == 'G' && code == kLimitCode) && lists(control, letter, code);
}

std::optional<bool> readAheadLimit(const Control& control, std::optional<double> p) {
  if (!lists(control, 'G', kLimitCode)) return std::nullopt;
  return p == 1;
}

std::string waitAdvice(const Control& control) {
  std::string out;
  const auto add = [&](const char* text) { out += (out.empty() ? "`" : " or `") + std::string(text) + "`"; };
  if (lists(control, 'G', 53)) add("G53");
  if (lists(control, 'G', 4)) add("G4 P0");
  if (lists(control, 'G', kLimitCode)) add("G103 P1");
  if (out.empty() && lists(control, 'M', 0)) add("M0");
  return out.empty() ? "a code that waits for it" : out;
}

} // namespace dotek::stdlib
