#include "tests/unit/SlowMacroB.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::tests {
namespace {

const char* name(SlowStop::Kind kind) {
  switch (kind) {
  case SlowStop::Kind::ProgramEnd: return "program end";
  case SlowStop::Kind::TextEnd: return "end of the text";
  case SlowStop::Kind::Alarm: return "alarm";
  case SlowStop::Kind::Budget: return "budget";
  case SlowStop::Kind::Unsupported: return "unsupported";
  }
  return "";
}

bool same(double a, double b) {
  return a == b || std::fabs(a - b) <= 1e-12 * std::max({1.0, std::fabs(a), std::fabs(b)});
}

std::string variables(const std::map<int, double>& values) {
  std::string out;
  for (const auto& [number, value] : values)
    out += fmt::format(" #{}={:.17g}", number, value);
  return out;
}

std::string differing(const char* what, const std::map<int, double>& a, const std::map<int, double>& b) {
  const auto text = [](const std::map<int, double>& values, int number) {
    const auto found = values.find(number);
    return found == values.end() ? std::string("null") : fmt::format("{:.17g}", found->second);
  };
  for (int number = 1; number < 1000; ++number) {
    if (!a.contains(number) && !b.contains(number)) continue;
    if (a.contains(number) && b.contains(number) && same(a.at(number), b.at(number))) continue;
    return fmt::format("{} #{}: {} and {}", what, number, text(a, number), text(b, number));
  }
  return "";
}

bool same(const MacroPosition& a, const MacroPosition& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (std::fabs(a[i] - b[i]) > 1e-9) return false;
  return true;
}

// Without those that stay where the machine is; it starts at 0.
std::vector<MacroPosition> visited(const std::vector<MacroPosition>& positions) {
  std::vector<MacroPosition> out{{}};
  for (const MacroPosition& position : positions)
    if (!same(out.back(), position)) out.push_back(position);
  return out;
}

std::string place(const MacroPosition& position) {
  return fmt::format("{:.3f} {:.3f} {:.3f}", position[0] + 0.0, position[1] + 0.0, position[2] + 0.0);
}

} // namespace

std::string describe(const MacroOutcome& outcome) {
  std::string out = name(outcome.ending);
  if (outcome.ending == SlowStop::Kind::Alarm) out += fmt::format(" {}", outcome.alarm);
  if (!outcome.reason.empty()) out += ": " + outcome.reason;
  out += fmt::format(", line {}, N{}\ncommon{}\nlocals{}\nmoves", outcome.line, outcome.sequence,
                     variables(outcome.common), variables(outcome.locals));
  for (const MacroPosition& position : outcome.positions)
    out += " (" + place(position) + ")";
  return out + "\nprinted\n" + outcome.output;
}

std::string difference(const MacroOutcome& slow, const MacroOutcome& other) {
  if (slow.ending != other.ending || slow.alarm != other.alarm)
    return fmt::format("ending: {} {} {} and {} {} {}", name(slow.ending), slow.alarm, slow.reason,
                       name(other.ending), other.alarm, other.reason);
  if (slow.ending == SlowStop::Kind::Budget) return ""; // the state is that of some block
  if (slow.ending != SlowStop::Kind::TextEnd && other.line != 0 && slow.line != other.line)
    return fmt::format("last line: {} and {}", slow.line, other.line);
  if (std::string text = differing("common", slow.common, other.common); !text.empty()) return text;
  if (std::string text = differing("local", slow.locals, other.locals); !text.empty()) return text;
  if (slow.output != other.output) return fmt::format("printed: {:?} and {:?}", slow.output, other.output);
  const std::vector<MacroPosition> a = visited(slow.positions);
  const std::vector<MacroPosition> b = visited(other.positions);
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i >= a.size() || i >= b.size()) return fmt::format("moves: {} and {}", a.size() - 1, b.size() - 1);
    if (!same(a[i], b[i])) return fmt::format("move {}: {} and {}", i, place(a[i]), place(b[i]));
  }
  return "";
}

} // namespace dotek::tests
