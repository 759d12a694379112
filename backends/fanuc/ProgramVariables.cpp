#include "backends/fanuc/ProgramVariables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace dotek::backends::fanuc {

namespace {

using stdlib::Control;
using stdlib::SystemVariables;

enum class Kind : std::uint8_t {
  Modal,
  ModalWord,
  BlockEnd,
  Machine,
  Position,
  Skip,
  ToolLength,
  External,
  WorkOffset,
  Extended,
  ToolWhole,
  ToolWear,
  ToolGeometry,
  Alarm,
  Timer,
  Hours,
  Message,
  ExtendedNumber,
};

struct Meaning {
  Kind kind = Kind::Modal;
  int index = 0; // group, word, work system, offset number
  int axis = 0;
  bool operator==(const Meaning&) const = default;
};

constexpr int kAxes = 6;       // of positions
constexpr int kOffsetAxes = 4; // of offsets
constexpr int kSystems = 6;
constexpr int kGroups = 99;
constexpr std::uint32_t kFirstSystem = 1000;

struct ModalWord {
  int offset;
  std::string_view what;
};
constexpr std::array kModalWords = {
    ModalWord{2, "B"},  ModalWord{7, "D"},  ModalWord{9, "F"},  ModalWord{11, "H"}, ModalWord{13, "M"},
    ModalWord{14, "N"}, ModalWord{15, "O"}, ModalWord{19, "S"}, ModalWord{20, "T"},
};

bool hasGroup(const Control& control, int group) {
  return std::any_of(control.codes.begin(), control.codes.end(),
                     [&](const stdlib::CodeInfo& code) { return code.group == group; });
}

// Each meaning of the control with its number, until `visit` gives true.
template <class Visit> bool eachMeaning(const Control& control, const Visit& visit) {
  const SystemVariables& v = control.variables;
  const auto at = [&](const std::optional<int>& base, Meaning meaning, int offset) {
    return base && visit(meaning, static_cast<std::uint32_t>(*base + offset));
  };
  for (int group = 1; v.modalFirst && group <= kGroups; ++group)
    if (hasGroup(control, group) && at(v.modalFirst, {Kind::Modal, group, 0}, group)) return true;
  for (const ModalWord& word : kModalWords)
    if (at(v.modalWords, {Kind::ModalWord, word.offset, 0}, word.offset)) return true;
  for (int axis = 0; axis < kAxes; ++axis) {
    if (at(v.blockEnd, {Kind::BlockEnd, 0, axis}, axis) || at(v.machine, {Kind::Machine, 0, axis}, axis) ||
        at(v.position, {Kind::Position, 0, axis}, axis) || at(v.skip, {Kind::Skip, 0, axis}, axis) ||
        at(v.toolLength, {Kind::ToolLength, 0, axis}, axis))
      return true;
  }
  for (int axis = 0; axis < kOffsetAxes; ++axis) {
    if (at(v.externalX, {Kind::External, 0, axis}, axis * v.axisStep)) return true;
    for (int system = 0; system < kSystems; ++system)
      if (at(v.workOffsetX, {Kind::WorkOffset, system, axis}, system * v.systemStep + axis * v.axisStep))
        return true;
    for (int p = 1; p <= v.extendedCount; ++p)
      if (at(v.extendedX, {Kind::Extended, p, axis}, (p - 1) * v.extendedStep + axis * v.axisStep))
        return true;
  }
  for (int n = 1; n <= v.toolCount; ++n) {
    const Kind wear = v.toolGeometry ? Kind::ToolWear : Kind::ToolWhole;
    if (at(v.toolWear, {wear, n, 0}, n) || at(v.toolGeometry, {Kind::ToolGeometry, n, 0}, n) ||
        at(v.toolWearToo, {wear, n, 0}, n) || at(v.toolGeometryToo, {Kind::ToolGeometry, n, 0}, n))
      return true;
  }
  return at(v.alarm, {Kind::Alarm, 0, 0}, 0) || at(v.timer, {Kind::Timer, 0, 0}, 0) ||
         at(v.hours, {Kind::Hours, 0, 0}, 0) || at(v.message, {Kind::Message, 0, 0}, 0) ||
         at(v.extendedNumber, {Kind::ExtendedNumber, 0, 0}, 0);
}

std::optional<Meaning> meaningOf(const Control& control, std::uint32_t number) {
  std::optional<Meaning> out;
  eachMeaning(control, [&](const Meaning& meaning, std::uint32_t at) {
    if (at == number) out = meaning;
    return at == number;
  });
  return out;
}

std::optional<std::uint32_t> numberOf(const Control& control, const Meaning& wanted) {
  std::optional<std::uint32_t> out;
  eachMeaning(control, [&](const Meaning& meaning, std::uint32_t at) {
    if (meaning == wanted) out = at;
    return meaning == wanted;
  });
  return out;
}

std::string axisName(int axis) {
  return axis < 3 ? std::string(1, "XYZ"[axis]) : "axis " + std::to_string(axis + 1);
}

std::string describe(const Meaning& meaning) {
  const std::string axis = axisName(meaning.axis);
  switch (meaning.kind) {
  case Kind::Modal: return fmt::format("the code in force of modal group {}", meaning.index);
  case Kind::ModalWord: {
    const auto at = std::find_if(kModalWords.begin(), kModalWords.end(),
                                 [&](const ModalWord& word) { return word.offset == meaning.index; });
    return fmt::format("the {} in force", at->what);
  }
  case Kind::BlockEnd: return axis + " of the end of the previous block";
  case Kind::Machine: return axis + " of the machine position";
  case Kind::Position: return axis + " of the position";
  case Kind::Skip: return axis + " of the skip position";
  case Kind::ToolLength: return axis + " of the tool offset in force";
  case Kind::External: return axis + " of the external work offset";
  case Kind::WorkOffset: return fmt::format("{} of the work offset of G{}", axis, 54 + meaning.index);
  case Kind::Extended: return fmt::format("{} of the work offset of G54.1 P{}", axis, meaning.index);
  case Kind::ToolWhole: return fmt::format("the tool offset {}", meaning.index);
  case Kind::ToolWear: return fmt::format("the wear of tool offset {}", meaning.index);
  case Kind::ToolGeometry: return fmt::format("the geometry of tool offset {}", meaning.index);
  case Kind::Alarm: return "the alarm";
  case Kind::Timer: return "the timer in milliseconds";
  case Kind::Hours: return "the timer in hours";
  case Kind::Message: return "the message";
  case Kind::ExtendedNumber: return "the P of G54.1 in force";
  }
  return "";
}

// No code of the group is in another group, or in none, on the other control.
bool sameGroup(int group, const Control& a, const Control& b) {
  const auto agrees = [&](const Control& one, const Control& other) {
    return std::all_of(one.codes.begin(), one.codes.end(), [&](const stdlib::CodeInfo& code) {
      const stdlib::CodeInfo* there = code.group == group ? other.find(code.letter, code.tenths) : nullptr;
      return there == nullptr || (there->group == group && there->function == code.function);
    });
  };
  return hasGroup(a, group) && hasGroup(b, group) && agrees(a, b) && agrees(b, a);
}

std::optional<bool> keptOf(const Control& control, std::uint32_t number) {
  if (number >= 1 && number <= control.locals) return false;
  for (const stdlib::VariableRange& range : control.common)
    if (number >= range.first && number <= range.last) return range.kept;
  return std::nullopt;
}

// Whether the position along the tool's axis holds its length; nothing: not known, or another variable.
std::optional<bool> lengthIn(const Control& control, const Meaning& meaning) {
  if (!control.withToolLength || meaning.axis != 2) return std::nullopt;
  if (meaning.kind == Kind::Position) return control.withToolLength->position;
  if (meaning.kind == Kind::Skip) return control.withToolLength->skip;
  return std::nullopt;
}

VariableThere refused(std::string why, std::string what = "") {
  return {std::nullopt, std::move(what), std::move(why)};
}

VariableThere plainVariable(std::uint32_t number, const Control& from, const Control& to) {
  const auto here = keptOf(from, number);
  const auto there = keptOf(to, number);
  if (here && !there)
    return refused(fmt::format("is no variable of {}, which has {}", to.title, variableRanges(to)));
  if (here && *here != *there) {
    VariableThere out = refused(
        *here
            ? fmt::format("keeps its value at power off on {}, and loses it on {}", from.title, to.title)
            : fmt::format("is empty after power on on {}, and keeps its value on {}", from.title, to.title));
    out.onlyKeptOtherwise = (number <= from.locals) == (number <= to.locals);
    out.lost = *here;
    return out;
  }
  if (here && (number <= from.locals) != (number <= to.locals))
    return refused(fmt::format("is local on one of {} and {}", from.title, to.title));
  if (!here && there)
    return refused(fmt::format("is no variable of {}, but one of {}", from.title, to.title));
  constexpr std::uint32_t kFirstCommon = 100; // from there on an option of the control may add some
  if (!here && !there && number > from.locals && number > to.locals && number < kFirstCommon)
    return refused(fmt::format("is no variable of {} or of {}", from.title, to.title));
  return {number, "", ""};
}

} // namespace

std::string variableRanges(const Control& control) {
  std::string out = fmt::format("#1 to #{}", control.locals);
  for (const stdlib::VariableRange& range : control.common)
    out += fmt::format(", #{} to #{}", range.first, range.last);
  return out;
}

bool sharesVariablesFrom(std::uint32_t first, const Control& to, const Control& from) {
  constexpr std::uint32_t kEnough = 30; // more than a row of holes has
  std::uint32_t shared = 0;
  while (shared < kEnough && keptOf(from, first + shared) && first + shared > from.locals &&
         keptOf(from, first + shared) == keptOf(to, first + shared))
    ++shared;
  return shared == kEnough || (shared > 0 && !keptOf(from, first + shared));
}

bool holdsVariablesOf(const Control& to, const Control& from) {
  if (to.locals != from.locals) return false;
  for (const stdlib::VariableRange& range : from.common)
    for (std::uint32_t n = range.first; n <= range.last; ++n)
      if (keptOf(to, n) != keptOf(from, n)) return false;
  return true;
}

bool sameVariables(const Control& from, const Control& to) {
  if (!holdsVariablesOf(to, from)) return false;
  return !eachMeaning(from, [&](const Meaning& meaning, std::uint32_t number) {
    return meaning.kind != Kind::Modal && meaningOf(to, number) != meaning;
  });
}

namespace {

using stdlib::StateRange;

const StateRange* stateOf(const Control& control, std::uint32_t number) {
  for (const StateRange& range : control.state)
    if (number >= range.first && number <= range.last) return &range;
  return nullptr;
}

} // namespace

VariableThere variableThere(std::uint32_t number, const Control& from, const Control& to) {
  if (number == 0 || (from.name == to.name && from.origin == to.origin)) return {number, "", ""};
  if (number < kFirstSystem) return plainVariable(number, from, to);
  const std::optional<Meaning> meaning = meaningOf(from, number);
  // A number that means something here may be one of the user's there.
  if (keptOf(from, number) || (keptOf(to, number) && !meaning)) return plainVariable(number, from, to);
  if (const StateRange* state = meaning ? nullptr : stateOf(from, number))
    for (const StateRange& other : to.state)
      if (other.title == state->title && other.last - other.first == state->last - state->first)
        return {other.first + (number - state->first), state->title, "", false};
  if (!meaning) return refused(fmt::format("has no meaning in the profile of {}", from.title));
  const std::string what = describe(*meaning);
  if (meaning->kind == Kind::Modal && !sameGroup(meaning->index, from, to))
    return refused(fmt::format("is {} on {}, and {} keeps other codes there", what, from.title, to.title),
                   what);
  const std::optional<std::uint32_t> there = numberOf(to, *meaning);
  if (!there)
    return refused(
        fmt::format("is {} on {}; the profile of {} has no variable for it", what, from.title, to.title),
        what);
  if (const auto length = lengthIn(from, *meaning); length != lengthIn(to, *meaning))
    return refused(
        fmt::format("is {} on {}; whether it holds the length of the tool as well is not the same on {}",
                    what, from.title, to.title),
        what);
  return {there, what, "", false};
}

} // namespace dotek::backends::fanuc
