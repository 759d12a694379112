#include "lint/LengthNumbers.h"

#include <algorithm>

namespace dotek::lint {
namespace {

void put(std::set<std::uint32_t>& into, std::optional<int> first) {
  if (first) into.insert(static_cast<std::uint32_t>(*first) + LengthNumbers::kZ);
}

} // namespace

LengthNumbers::LengthNumbers(const Project& project) {
  if (project.control != nullptr) add(*project.control);
  for (const stdlib::Control& control : project.controls)
    add(control);
  for (const stdlib::Control& control : project.controls)
    drop(control);
}

bool LengthNumbers::isToolOffset(std::uint32_t number) const {
  return std::any_of(toolOffsets.begin(), toolOffsets.end(), [&](const stdlib::VariableRange& range) {
    return number >= range.first && number <= range.last;
  });
}

const LengthNumbers::Wear* LengthNumbers::wearOf(std::uint32_t number) const {
  const auto found = std::find_if(wears.begin(), wears.end(), [&](const Wear& one) {
    return number >= one.wear.first && number <= one.wear.last;
  });
  return found == wears.end() ? nullptr : &*found;
}

void LengthNumbers::add(const stdlib::Control& control) {
  const stdlib::SystemVariables& v = control.variables;
  if (control.withToolLength && control.withToolLength->position) put(positions, v.position);
  if (control.withToolLength && control.withToolLength->skip) put(positions, v.skip);
  put(machine, v.machine);
  put(length, v.toolLength);
  toolOffsets.insert(toolOffsets.end(), control.toolOffsets.begin(), control.toolOffsets.end());
  const auto zero = [&](std::optional<int> first, int system) {
    if (first) zeroes.insert(static_cast<std::uint32_t>(*first + system + 2 * v.axisStep));
  };
  zero(v.externalX, 0);
  for (int system = 0; system < 6; ++system)
    zero(v.workOffsetX, system * v.systemStep);
  for (int system = 0; system < v.extendedCount; ++system)
    zero(v.extendedX, system * v.extendedStep);
  const auto wear = [&](std::optional<int> first, std::optional<int> geometry) {
    if (!first || !geometry) return;
    const auto number = static_cast<std::uint32_t>(*first);
    // Where nobody names the control, the first profile decides what a table holds; the message names others.
    if (std::any_of(wears.begin(), wears.end(), [&](const Wear& one) { return one.geometry == number; }))
      return;
    wears.push_back({{number + 1, number + static_cast<std::uint32_t>(v.toolCount)},
                     static_cast<std::uint32_t>(*geometry),
                     control.name});
  };
  wear(v.toolWear, v.toolGeometry);
  wear(v.toolWearToo, v.toolGeometryToo);
}

// Where nobody names the control, what holds on all of them counts; the wear is that of controls which have
// one.
void LengthNumbers::drop(const stdlib::Control& control) {
  const stdlib::SystemVariables& v = control.variables;
  const auto erase = [&](std::optional<int> first, bool held) {
    if (first && !held) positions.erase(static_cast<std::uint32_t>(*first) + kZ);
  };
  erase(v.position, control.withToolLength && control.withToolLength->position);
  erase(v.skip, control.withToolLength && control.withToolLength->skip);
}

} // namespace dotek::lint
