#include "sim/machine/EndText.h"

#include <fmt/format.h>

namespace dotek::sim {

std::string callersText(const RunEnd& end) {
  std::string out;
  for (auto frame = end.stack.rbegin(); frame != end.stack.rend(); ++frame) {
    std::string one;
    if (frame->program != 0) one += fmt::format("O{:04}", frame->program);
    if (frame->sequence != 0) one += fmt::format("{}N{}", one.empty() ? "" : " ", frame->sequence);
    if (!one.empty()) out += (out.empty() ? "" : ", called by ") + one;
  }
  return out;
}

std::string alarmName(const RunEnd& end) {
  return end.number == 0 ? "an alarm whose number is not known" : fmt::format("alarm {}", end.number);
}

std::string systemName(const Machine& machine) {
  if (machine.control().find(stdlib::Function::WorkSystem) == nullptr) return "work"; // it has one
  const std::uint8_t system = machine.mode(kSystem);
  return system == kExtended ? fmt::format("G54.1 P{}", machine.extendedSystem())
                             : fmt::format("G{}", 54 + system);
}

} // namespace dotek::sim
