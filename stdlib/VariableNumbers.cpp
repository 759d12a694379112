#include "stdlib/VariableNumbers.h"

#include "stdlib/RadiusOffsets.h"

#include <algorithm>

namespace dotek::stdlib {
namespace {

constexpr long kAxes = 6;    // of positions and offsets
constexpr long kGroups = 64; // of modal codes
constexpr long kWords = 31;  // of modal words: 2 B to 30 P

bool within(std::optional<int> first, long number, long count) {
  return first && number >= *first && number < *first + count;
}

// Offsets of `systems` systems; axes and systems have steps of their own.
bool isOffset(std::optional<int> first, long number, int axisStep, int systemStep, int systems) {
  for (int system = 0; first && system < systems; ++system)
    for (long axis = 0; axis < kAxes; ++axis)
      if (number == *first + system * systemStep + axis * axisStep) return true;
  return false;
}

// The code in force of a group that no code of the control is in: what it holds nobody knows.
bool isOfEmptyGroup(const Control& control, long number) {
  const std::optional<int> first = control.variables.modalFirst;
  return within(first, number, kGroups) &&
         std::none_of(control.codes.begin(), control.codes.end(), [&](const CodeInfo& code) {
           return code.letter == 'G' && code.group == number - *first;
         });
}

} // namespace

bool namesVariable(const Control& control, std::uint32_t variable) {
  const SystemVariables& v = control.variables;
  const auto number = static_cast<long>(variable);
  if (isOfEmptyGroup(control, number)) return false;
  for (const StateRange& range : control.state)
    if ((variable >= range.first && variable <= range.last) || range.word == variable) return true;
  if (control.window)
    for (const std::uint32_t one :
         {control.window->address, control.window->byte, control.window->word, control.window->doubleWord})
      if (one == variable) return true;
  const auto one = [&](std::optional<int> first) { return within(first, number, 1); };
  if (one(v.alarm) || one(v.timer) || one(v.hours) || one(v.message) || one(v.extendedNumber) ||
      one(v.modalFeed))
    return true;
  const auto axes = [&](std::optional<int> first) { return within(first, number, kAxes); };
  if (axes(v.blockEnd) || axes(v.machine) || axes(v.position) || axes(v.skip) || axes(v.toolLength))
    return true;
  return within(v.modalFirst, number, kGroups) || within(v.modalWords, number, kWords) ||
         isOfTools(control, variable) || isOffset(v.externalX, number, v.axisStep, 0, 1) ||
         isOffset(v.workOffsetX, number, v.axisStep, v.systemStep, 6) ||
         isOffset(v.extendedX, number, v.axisStep, v.extendedStep, v.extendedCount) ||
         control.isReadOnly(variable);
}

bool isReadAlone(const Control& control, std::uint32_t variable) {
  if (control.isReadOnly(variable)) return true;
  const auto number = static_cast<long>(variable);
  const SystemVariables& v = control.variables;
  if (within(v.toolWear, number, 1) || within(v.toolGeometry, number, 1) ||
      within(v.toolWearToo, number, 1) || within(v.toolGeometryToo, number, 1))
    return true;
  return std::any_of(control.state.begin(), control.state.end(), [&](const StateRange& range) {
    const bool isOne = (variable >= range.first && variable <= range.last) || range.word == variable;
    return isOne && (range.access == StateRange::Access::ReadOnly || range.null);
  });
}

bool isOfTools(const Control& control, std::uint32_t variable) {
  const SystemVariables& v = control.variables;
  const RadiusOffsets radii = radiusOffsets(control);
  const auto number = static_cast<long>(variable);
  return within(v.toolWear, number, v.toolCount + 1) || within(v.toolGeometry, number, v.toolCount + 1) ||
         within(v.toolWearToo, number, v.toolCount + 1) ||
         within(v.toolGeometryToo, number, v.toolCount + 1) || within(radii.wear, number, v.toolCount + 1) ||
         within(radii.geometry, number, v.toolCount + 1);
}

bool isOfOffsets(const Control& control, std::uint32_t variable) {
  const SystemVariables& v = control.variables;
  const auto among = [&](long number) {
    return isOffset(v.externalX, number, v.axisStep, 0, 1) ||
           isOffset(v.workOffsetX, number, v.axisStep, v.systemStep, 6) ||
           isOffset(v.extendedX, number, v.axisStep, v.extendedStep, v.extendedCount);
  };
  const auto number = static_cast<long>(variable);
  const bool before = v.extendedX && number < *v.extendedX; // what P is added to
  return among(number) || among(number + 1) ||
         (before && (among(number + v.extendedStep) || among(number + v.extendedStep + 1)));
}

} // namespace dotek::stdlib
