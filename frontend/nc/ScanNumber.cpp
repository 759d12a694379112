#include "frontend/nc/ScanNumber.h"

#include <algorithm>
#include <charconv>

namespace dotek::frontend::nc {
namespace {

const char* skipBlanks(const char* p) {
  while (*p == ' ' || *p == '\t')
    ++p;
  return p;
}

// More digits than any control reads; the line is bounded anyway.
constexpr std::size_t kMostDigits = 40;

} // namespace

ScannedNumber scanLongNumber(const char* p) {
  ScannedNumber out;
  p = skipBlanks(p);
  out.minus = *p == '-';
  if (*p == '-' || *p == '+') p = skipBlanks(p + 1);
  const char* const begin = p;
  std::size_t digits = 0, significant = 0;
  for (;; ++p) {
    if (*p == '.' && !out.point) {
      out.point = true;
      continue;
    }
    if (*p < '0' || *p > '9') break;
    ++digits;
    out.places += out.point ? 1 : 0;
    if (significant > 0 || *p != '0') ++significant;
    if (significant <= 18) out.digits = out.digits * 10 + static_cast<unsigned>(*p - '0');
  }
  if (digits == 0 || digits > kMostDigits || *p == '.') {
    out.fault = digits == 0 ? NumberFault::Missing : NumberFault::TooLong;
    return out;
  }
  if (significant > 18) out.digits = UINT64_MAX;
  if (significant <= 15 && out.places < kPowersOfTen.size())
    out.value = static_cast<double>(out.digits) / kPowersOfTen[out.places];
  else
    std::from_chars(begin, p, out.value, std::chars_format::fixed);
  if (out.minus) out.value = -out.value;
  out.behind = p;
  return out;
}

} // namespace dotek::frontend::nc
