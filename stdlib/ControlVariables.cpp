// Variables of a control: where it keeps its state, and what Dotek only keeps.
#include "stdlib/ControlReader.h"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>

namespace dotek::stdlib {
namespace {

std::string_view remedy(const Control* base) {
  return base == nullptr ? "" : "; `remove = { variables = [..] }` takes an inherited one away";
}

} // namespace

void ControlReader::variables() {
  const ControlSection table = section("variables", "system variables");
  origin(table);
  SystemVariables& v = control_.variables;
  const auto number = [&](std::string_view key) -> std::optional<int> {
    const TomlValue value = table.value(key);
    if (!value) return std::nullopt;
    return static_cast<int>(value.integer(1000, 1000, 999999));
  };
  v.modalFirst = number("modal_first");
  v.modalFeed = number("modal_feed");
  v.blockEnd = number("block_end");
  v.machine = number("machine");
  v.position = number("position");
  v.skip = number("skip");
  v.externalX = number("external_x");
  v.workOffsetX = number("work_offset_x");
  v.extendedX = number("extended_x");
  v.extendedStep = static_cast<int>(table.value("extended_step").integer(0, 1, 9999));
  v.extendedCount = static_cast<int>(table.value("extended_count").integer(0, 1, 300));
  v.toolWear = number("tool_wear");
  v.toolGeometry = number("tool_geometry");
  v.toolWearToo = number("tool_wear_too");
  v.toolGeometryToo = number("tool_geometry_too");
  v.toolCount = static_cast<int>(table.value("tool_count").integer(0, 1, 999));
  v.modalWords = number("modal_words");
  v.toolLength = number("tool_length");
  v.alarm = number("alarm");
  v.timer = number("timer");
  v.hours = number("hours");
  v.message = number("message");
  v.extendedNumber = number("extended_number");
  v.systemStep = static_cast<int>(table.value("system_step").integer(0, 1, 9999));
  v.axisStep = static_cast<int>(table.value("axis_step").integer(0, 1, 9999));
  if (v.workOffsetX && v.systemStep == 0)
    document_.fail(table.range("work_offset_x"), "`work_offset_x` is without `system_step`");
  if ((v.workOffsetX || v.externalX) && v.axisStep == 0)
    document_.fail(table.range(v.workOffsetX ? "work_offset_x" : "external_x"),
                   "an offset of X is without `axis_step`");
  if (v.extendedX && (v.extendedStep == 0 || v.extendedCount == 0))
    document_.fail(table.range("extended_x"), "`extended_x` is without `extended_step` and `extended_count`");
  if (v.toolWearToo && !v.toolWear)
    document_.fail(table.range("tool_wear_too"), "`tool_wear_too` is without `tool_wear`");
  if (v.toolGeometryToo && !v.toolGeometry)
    document_.fail(table.range("tool_geometry_too"), "`tool_geometry_too` is without `tool_geometry`");
  if ((v.toolWear || v.toolGeometry) && v.toolCount == 0)
    document_.fail(table.range(v.toolWear ? "tool_wear" : "tool_geometry"),
                   "tool offsets are without `tool_count`");
  Taken blocks;
  const auto add = [&](std::string_view key, std::optional<int> first, int count, int step = 1) {
    for (int i = 0; first && i < count; ++i)
      blocks.emplace_back(key, *first + i * step);
  };
  add("modal_feed", v.modalFeed, 1);
  add("block_end", v.blockEnd, 3);
  add("machine", v.machine, 3);
  add("position", v.position, 3);
  add("skip", v.skip, 3);
  add("external_x", v.externalX, 3, v.axisStep);
  for (int system = 0; v.workOffsetX && system < 6; ++system)
    add("work_offset_x", *v.workOffsetX + system * v.systemStep, 3, v.axisStep);
  for (int system = 0; v.extendedX && system < v.extendedCount; ++system)
    add("extended_x", *v.extendedX + system * v.extendedStep, 3, v.axisStep);
  for (const auto& [key, first] :
       {std::pair("tool_wear", v.toolWear), std::pair("tool_geometry", v.toolGeometry),
        std::pair("tool_wear_too", v.toolWearToo), std::pair("tool_geometry_too", v.toolGeometryToo)})
    add(key, first ? std::optional<int>(*first + 1) : std::nullopt, v.toolCount);
  add("tool_length", v.toolLength, 3);
  add("alarm", v.alarm, 1);
  add("timer", v.timer, 1);
  add("hours", v.hours, 1);
  add("message", v.message, 1);
  add("extended_number", v.extendedNumber, 1);
  if (v.modalFirst) {
    for (const CodeInfo& code : control_.codes)
      if (code.group) blocks.emplace_back("modal_first", *v.modalFirst + *code.group);
  }
  for (const auto& [key, member] :
       {std::pair("modal_first", &v.modalFirst), std::pair("modal_feed", &v.modalFeed),
        std::pair("block_end", &v.blockEnd), std::pair("machine", &v.machine),
        std::pair("position", &v.position), std::pair("skip", &v.skip), std::pair("external_x", &v.externalX),
        std::pair("work_offset_x", &v.workOffsetX), std::pair("extended_x", &v.extendedX),
        std::pair("tool_wear", &v.toolWear), std::pair("tool_geometry", &v.toolGeometry),
        std::pair("tool_wear_too", &v.toolWearToo), std::pair("tool_geometry_too", &v.toolGeometryToo),
        std::pair("tool_length", &v.toolLength), std::pair("alarm", &v.alarm), std::pair("timer", &v.timer),
        std::pair("hours", &v.hours), std::pair("message", &v.message),
        std::pair("extended_number", &v.extendedNumber)})
    takeAway(table, key, *member, blocks);
  state(blocks);
  window(blocks);
  package();
  overlaps(table, blocks);
  withToolLength();
}

// An inherited key whose variables `remove` names.
void ControlReader::takeAway(const ControlSection& table, std::string_view key, std::optional<int>& member,
                             Taken& blocks) {
  if (!member || removedVariables_.empty() || table.owns(key)) return;
  std::size_t all = 0, removed = 0;
  for (const auto& [other, number] : blocks) {
    if (other != key) continue;
    ++all;
    removed += isRemoved(static_cast<std::uint32_t>(number)) ? 1 : 0;
  }
  if (removed == 0) return;
  if (removed < all)
    document_.fail(
        roots_.front().value("remove").range(),
        fmt::format("a part of the variables of `{}`, which begin at #{}, cannot be removed; state "
                    "`{}` and its count in [variables], or remove all of them",
                    key, *member, key));
  std::erase_if(blocks, [&, key = key](const auto& block) { return block.first == key; });
  member.reset();
  removedKeys_.emplace_back(key);
}

void ControlReader::withToolLength() {
  const ControlSection table = optional("with_tool_length");
  if (!table) return;
  const Origin from = origin(table);
  LengthInPositions out{false, false, from.grade, from.source};
  for (const TomlValue& item : table.require("variables", "a list of position and skip").items()) {
    const bool skip = item.choice({"position", "skip"}, "position") == "skip";
    bool& held = skip ? out.skip : out.position;
    if (!(skip ? control_.variables.skip : control_.variables.position)) {
      if (table.owns("variables"))
        document_.fail(item.range(), fmt::format("`{}` is no variable of this control", item.text()));
      continue; // it was removed
    }
    if (held) document_.fail(item.range(), fmt::format("`{}` is given twice", item.text()));
    held = true;
  }
  control_.withToolLength = std::move(out);
}

void ControlReader::overlaps(const ControlSection& table, const Taken& blocks) const {
  std::map<int, std::string_view> taken;
  for (const auto& [key, number] : blocks) {
    SourceRange range = table.range(key);
    if (const TomlValue own = roots_.front().value(key); own && !table.owns(key)) range = own.range();
    const auto [at, added] = taken.try_emplace(number, key);
    const bool shared = key == "modal_first" && at->second == key; // one group, many codes
    if (!added && !shared)
      document_.fail(range, fmt::format("#{} is a variable of `{}` {}{}", number, at->second,
                                        at->second != key                   ? fmt::format("and of `{}`", key)
                                        : key == "state" || key == "window" ? "twice"
                                                                            : "twice: its steps meet",
                                        remedy(base_)));
    if (control_.isCommon(static_cast<std::uint32_t>(number)))
      document_.fail(range, fmt::format("#{} is a common variable{}", number, remedy(base_)));
  }
}

// Each may be written by `--var`; what a program may do says `access`.
void ControlReader::state(Taken& blocks) {
  for (const TomlTable& table : own("state")) {
    const Origin origin = ControlReader::origin(table);
    if (control_.state.size() == kMostRanges)
      document_.fail(table.range(), fmt::format("more than {} ranges", kMostRanges));
    StateRange range;
    range.first = whole(table, "first", "a variable number", 1000, 999999);
    range.last = static_cast<std::uint32_t>(table.value("last").integer(range.first, 1000, 999999));
    range.title = table.require("title", "what it holds").text();
    range.grade = origin.grade;
    range.source = origin.source;
    const std::string access = table.require("access", "read-only, store or effect")
                                   .choice({"read-only", "store", "effect"}, "read-only");
    range.access = access == "store"    ? StateRange::Access::Store
                   : access == "effect" ? StateRange::Access::Effect
                                        : StateRange::Access::ReadOnly;
    if (const TomlValue initial = table.value("initial")) {
      if (initial.isText())
        range.null = initial.choice({"null"}, "null") == "null";
      else
        range.initial = initial.number();
    }
    if (range.first > range.last || range.last - range.first > 999)
      document_.fail(table.range(),
                     fmt::format("#{} to #{} is no range of at most 1000", range.first, range.last));
    if (const TomlValue word = table.value("word")) {
      range.word = static_cast<std::uint32_t>(word.integer(1000, 1000, 999999));
      if (range.last - range.first > 31) document_.fail(word.range(), "a word holds 32 bits at most");
    }
    control_.state.push_back(std::move(range));
  }
  if (base_ != nullptr) inheritStates();
  for (const StateRange& range : control_.state) {
    if (range.word) blocks.emplace_back("state", static_cast<int>(*range.word));
    for (std::uint32_t n = range.first; n <= range.last && n - range.first < 1000; ++n)
      blocks.emplace_back("state", static_cast<int>(n));
  }
}

void ControlReader::window(Taken& blocks) {
  const ControlSection table = optional("window");
  if (!table) return;
  origin(table);
  PmcWindow window;
  window.area = table.require("area", "the letter of the memory").text();
  window.bytes = whole(table, "bytes", "the size of the memory", 1, 1 << 20);
  const auto number = [&](std::string_view key) -> std::uint32_t {
    const TomlValue value = table.value(key);
    if (!value) return 0;
    const auto out = static_cast<std::uint32_t>(value.integer(1000, 1000, 999999));
    blocks.emplace_back("window", static_cast<int>(out));
    return out;
  };
  window.address = number("address");
  if (window.address != 0 && !table.owns("address") && isRemoved(window.address)) {
    std::erase_if(blocks, [](const auto& block) { return block.first == "window"; });
    removedKeys_.emplace_back("window");
    return;
  }
  window.byte = number("byte");
  window.word = number("word");
  window.doubleWord = number("double_word");
  if (window.address == 0)
    document_.fail(table.range(), "`address` is missing: the variable that chooses the place");
  control_.window = std::move(window);
}

// [macro_package]: see MacroPackage.
void ControlReader::package() {
  const ControlSection table = optional("macro_package");
  if (!table) return;
  origin(table);
  MacroPackage out;
  out.set = table.require("set", "the macro set that is delivered with other numbers").text();
  out.title = table.require("title", "the name of the package").text();
  out.shift = whole(table, "shift", "how far #100 to #149 are moved", 0, 900);
  out.calibrationFirst =
      whole(table, "calibration_first", "the first variable of the calibration", 100, 9999);
  out.calibrationLast = whole(table, "calibration_last", "the last variable of the calibration", 100, 9999);
  out.radiusX = whole(table, "radius_x", "the variable of the ball's radius in X", 100, 9999);
  out.radiusY = whole(table, "radius_y", "the variable of the ball's radius in Y", 100, 9999);
  if (out.calibrationLast < out.calibrationFirst)
    document_.fail(table.range("calibration_last"), "`calibration_last` is less than `calibration_first`");
  if (table.value("extended_first")) {
    out.extendedFirst =
        table.require("extended_first", "the number that stands for the first system").number();
    out.extendedLast = table.require("extended_last", "the last number of these systems").number();
    out.extendedStep = table.require("extended_step", "how far these numbers are apart").number();
    if (out.extendedFirst <= 6 || out.extendedLast < out.extendedFirst || out.extendedStep <= 0)
      document_.fail(table.range("extended_first"), "numbers of systems beyond G59 rise from above 6");
  }
  control_.package = std::move(out);
}

} // namespace dotek::stdlib
