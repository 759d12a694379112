#include "sim/machine/Trace.h"

#include "support/Decimal.h"
#include "support/Printable.h"
#include "support/Source.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace dotek::sim {
namespace {

constexpr std::size_t kFlushAt = 64 * 1024;

void appendNumber(std::string& out, std::uint64_t value) {
  char digits[20];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  out.append(digits, end);
}

} // namespace

void appendFixed6(std::string& out, double value) {
  const double size = std::abs(value);
  const double scaled = size * 1e6;
  const double whole = std::floor(scaled + 0.5);
  // Clear of the halves the sixth decimal is certain; near one the decimal text decides.
  if (!(size < 1e6) || std::abs(std::abs(scaled - whole) - 0.5) < 1e-3) {
    out += std::isfinite(value) ? fixedText(value, 6) : "?";
    return;
  }
  const auto units = static_cast<std::uint64_t>(whole);
  if (value < 0 && units != 0) out += '-';
  appendNumber(out, units / 1'000'000);
  char decimals[7] = {'.', '0', '0', '0', '0', '0', '0'};
  std::uint64_t rest = units % 1'000'000;
  for (int i = 6; i > 0; --i, rest /= 10)
    decimals[i] = static_cast<char>('0' + rest % 10);
  out.append(decimals, sizeof decimals);
}

Trace::Trace(std::function<void(std::string_view)> sink, bool lines) : sink_(std::move(sink)), lines_(lines) {
  text_.reserve(kFlushAt + 1024);
}

Trace::~Trace() {
  flush();
}

Trace& Trace::begin(std::string_view action) {
  if (lines_) {
    appendNumber(text_, line_);
    text_ += ' ';
  }
  text_ += action;
  return *this;
}

Trace& Trace::word(std::string_view name, double value) {
  text_ += ' ';
  text_ += name;
  appendFixed6(text_, value);
  return *this;
}

Trace& Trace::text(std::string_view text) {
  text_ += ' ';
  std::string line(text);
  for (char& c : line) // a line of the trace is one line
    if (c == '\n' || c == '\r') c = ' ';
  text_ += printable(isUtf8(line) ? line : toUtf8(line, Encoding::Cp1250));
  return *this;
}

Trace& Trace::position(const Position& position, std::uint32_t shown) {
  for (std::size_t i = 0; i < kAxes; ++i) {
    if ((i >= 3 || (lathe_ && i == 1)) && (shown >> i & 1) == 0) continue;
    text_ += ' ';
    text_ += kAxisLetters[i];
    appendFixed6(text_, i == 0 && diameters_ ? 2 * position[i] : position[i]);
  }
  return *this;
}

void Trace::end() {
  text_ += '\n';
  if (text_.size() >= kFlushAt && !held_) flush();
}

std::size_t Trace::takeTo(std::size_t place, std::size_t begin) {
  const std::size_t size = text_.size() - begin;
  if (place < begin) {
    const auto at = [&](std::size_t offset) { return text_.begin() + static_cast<std::ptrdiff_t>(offset); };
    std::rotate(at(place), at(begin), text_.end());
  }
  return size;
}

void Trace::flush() {
  if (text_.empty()) return;
  sink_(text_);
  text_.clear();
}

} // namespace dotek::sim
