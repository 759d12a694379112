// Codes and alarms of a control.
#include "stdlib/CodeSpan.h"
#include "stdlib/ControlReader.h"
#include "support/NearestName.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::stdlib {
namespace {

constexpr std::string_view kFunctionNames[] = {
#define DOTEK_FUNCTION(id, name) name,
    DOTEK_FUNCTIONS(DOTEK_FUNCTION)
#undef DOTEK_FUNCTION
};

constexpr std::string_view kAlarmNames[] = {
#define DOTEK_ALARM(id, name) name,
    DOTEK_ALARMS(DOTEK_ALARM)
#undef DOTEK_ALARM
};

// Functions that one modal group holds together, and no group holds two of: contradictions show here.
enum class Family : std::uint8_t {
  None,
  Motion,
  Plane,
  Unit,
  CutterComp,
  ToolLength,
  Scaling,
  System,
  Mirror,
  Polar,
  Rotation,
  Canned,
  ReturnLevel,
  SurfaceSpeed,
  ModalCall,
  Distance,
  Feed
};

Family familyOf(Function function) {
  switch (function) {
  case Function::Rapid:
  case Function::ArcClockwise:
  case Function::ArcCounterClockwise:
  case Function::Feed: return Family::Motion;
  case Function::PlaneXY:
  case Function::PlaneZX:
  case Function::PlaneYZ: return Family::Plane;
  case Function::Inch:
  case Function::Metric: return Family::Unit;
  case Function::CutterCompLeft:
  case Function::CutterCompRight:
  case Function::CutterCompOff: return Family::CutterComp;
  case Function::ToolLengthPlus:
  case Function::ToolLengthMinus:
  case Function::ToolLengthOff: return Family::ToolLength;
  case Function::ScalingOn:
  case Function::ScalingOff: return Family::Scaling;
  case Function::MirrorOn:
  case Function::MirrorOff: return Family::Mirror;
  case Function::PolarOn:
  case Function::PolarOff: return Family::Polar;
  case Function::WorkSystem:
  case Function::ExtendedWorkSystem: return Family::System;
  case Function::RotationOn:
  case Function::RotationOff: return Family::Rotation;
  case Function::CannedCycle:
  case Function::BackBoring:
  case Function::CannedCycleOff: return Family::Canned;
  case Function::ReturnInitial:
  case Function::ReturnR: return Family::ReturnLevel;
  case Function::SurfaceSpeedOn:
  case Function::SurfaceSpeedOff: return Family::SurfaceSpeed;
  case Function::ModalCall:
  case Function::ModalCallOff: return Family::ModalCall;
  case Function::Absolute:
  case Function::Incremental: return Family::Distance;
  case Function::FeedPerMinute:
  case Function::FeedPerRevolution: return Family::Feed;
  default: return Family::None;
  }
}

// "M100-M199 ..", not "G90 ..".
bool isCodeRange(std::string_view text) {
  const std::string_view name = text.substr(0, std::min(text.find(' '), text.find(':')));
  const std::size_t dash = name.find('-');
  return dash != std::string_view::npos && dash > 1 && name[dash - 1] >= '0' && name[dash - 1] <= '9';
}

// The letter of codes with this meaning; 0: either.
char letterOf(Function function) {
  if (function == Function::Other || function == Function::ProbeOn || function == Function::ProbeOff ||
      function == Function::Auxiliary)
    return 0;
  return function >= Function::Stop && function <= Function::Return ? 'M' : 'G'; // those of a lathe follow
}

} // namespace

std::string codeText(char letter, std::uint32_t tenths) {
  return tenths % 10 == 0 ? fmt::format("{}{}", letter, tenths / 10)
                          : fmt::format("{}{}.{}", letter, tenths / 10, tenths % 10);
}

std::string_view functionName(Function function) {
  return kFunctionNames[static_cast<std::size_t>(function)];
}

std::string_view alarmName(Alarm alarm) {
  return kAlarmNames[static_cast<std::size_t>(alarm)];
}

void ControlReader::codes(const TomlTable& table) {
  const Origin origin = ControlReader::origin(table);
  std::optional<int> group;
  if (const TomlValue value = table.value("group")) group = static_cast<int>(value.integer(1, 1, 99));
  for (const TomlValue& item : table.require("list", "a list of codes").items()) {
    if (control_.codes.size() == kMostCodes)
      document_.fail(item.range(), fmt::format("more than {} codes", kMostCodes));
    if (isCodeRange(item.text())) continue; // after all others
    std::optional<CodeInfo> code = parseCode(item);
    if (!code) continue;
    code->group = group;
    code->grade = origin.grade;
    code->source = origin.source;
    check(*code, item);
    control_.codes.push_back(std::move(*code));
  }
}

// "M100-M199 auxiliary: of the builder": those codes of the range that nothing else lists.
void ControlReader::codeRanges(const TomlTable& table) {
  const Origin origin = ControlReader::origin(table);
  for (const TomlValue& item : table.require("list", "a list of codes").items()) {
    const std::string text = item.text();
    if (!isCodeRange(text)) continue;
    const std::size_t blank = text.find(' '), colon = text.find(": ");
    const auto span = codeSpan(text.substr(0, std::min(blank, colon)));
    const bool formed = span && blank < colon && colon + 2 < text.size();
    if (!formed || text.substr(blank + 1, colon - blank - 1) != functionName(Function::Auxiliary)) {
      document_.fail(item.range(),
                     fmt::format("`{}` is no range of codes; `M100-M199 auxiliary: of the builder` is the "
                                 "form, and other meanings are stated code by code",
                                 text));
      continue;
    }
    const auto [letter, first, last] = *span;
    for (std::uint32_t tenths = first; tenths <= last; tenths += 10) {
      const bool calls = std::any_of(
          control_.callCodes.begin(), control_.callCodes.end(), [&, letter = letter](const CallCode& call) {
            return call.program != 0 && call.letter == letter && tenths / 10 >= call.first &&
                   tenths / 10 < call.first + call.count;
          });
      if (calls || control_.find(letter, tenths) != nullptr) continue;
      if (control_.codes.size() == kMostCodes)
        document_.fail(item.range(), fmt::format("more than {} codes", kMostCodes));
      CodeInfo code;
      code.letter = letter;
      code.tenths = tenths;
      code.function = Function::Auxiliary;
      code.title = text.substr(colon + 2);
      code.grade = origin.grade;
      code.source = origin.source;
      control_.codes.push_back(std::move(code));
    }
  }
}

// "G54.1 extended-work-system: additional work coordinate system"; without a function: other.
std::optional<CodeInfo> ControlReader::parseCode(const TomlValue& item) const {
  const std::string text = item.text();
  const auto fail = [&](const std::string& message) {
    document_.fail(item.range(), message);
    return std::nullopt;
  };
  const std::size_t colon = text.find(": ");
  if (colon == std::string::npos || colon + 2 == text.size())
    return fail(fmt::format("`{}` has no title; `G90 absolute: absolute programming` is the form", text));
  CodeInfo code;
  code.title = text.substr(colon + 2);
  const std::string head = text.substr(0, colon);
  const std::size_t blank = std::min(head.find(' '), head.size());
  const std::string name = head.substr(0, blank);
  if (blank < head.size()) {
    const std::string function = head.substr(blank + 1);
    const auto at = std::find(std::begin(kFunctionNames), std::end(kFunctionNames), function);
    if (at == std::end(kFunctionNames)) {
      const std::string near = nearestName(
          function, std::vector<std::string_view>(std::begin(kFunctionNames), std::end(kFunctionNames)));
      return fail(fmt::format("`{}` is no meaning of a code{}", function,
                              near.empty() ? "" : "; the nearest is `" + near + "`"));
    }
    code.function = static_cast<Function>(at - std::begin(kFunctionNames));
  }
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t at = 1;
  while (at < name.size() && digit(name[at]) && at < 6)
    code.tenths = code.tenths * 10 + static_cast<std::uint32_t>(name[at++] - '0');
  code.tenths *= 10;
  bool good = at > 1 && (name[0] == 'G' || name[0] == 'M') && (at == 2 || name[1] != '0');
  if (good && at + 2 == name.size() && name[at] == '.' && digit(name[at + 1]) && name[at + 1] != '0')
    code.tenths += static_cast<std::uint32_t>(name[at + 1] - '0');
  else
    good = good && at == name.size();
  if (!good) return fail(fmt::format("`{}` is no code; `G0`, `G54.1` or `M30` is the form", name));
  code.letter = name[0];
  return code;
}

void ControlReader::check(const CodeInfo& code, const TomlValue& item) {
  const std::string name = codeText(code.letter, code.tenths);
  if (control_.find(code.letter, code.tenths) != nullptr)
    document_.fail(item.range(), fmt::format("`{}` is given twice", name));
  const char letter = letterOf(code.function);
  if (letter != 0 && letter != code.letter)
    document_.fail(item.range(), fmt::format("`{}` is no {} function, which `{}` is",
                                             functionName(code.function), code.letter, name));
  if (code.letter == 'M' && code.group)
    document_.fail(item.range(),
                   fmt::format("`{}` is in modal group {}, which holds G codes", name, *code.group));
  if (code.function == Function::WorkSystem &&
      (code.tenths % 10 != 0 || code.tenths < 540 || code.tenths > 590))
    document_.fail(item.range(), fmt::format("`{}` is no work system; they are G54 to G59", name));
  const Family family = familyOf(code.function);
  if (family == Family::None) return;
  for (const CodeInfo& other : control_.codes) {
    const Family otherFamily = familyOf(other.function);
    if (otherFamily == Family::None) continue;
    const bool sameGroup = code.group == other.group;
    if (family == otherFamily && !sameGroup)
      document_.fail(item.range(), fmt::format("`{}` belongs with `{}` and is in another group", name,
                                               codeText(other.letter, other.tenths)));
    if (family != otherFamily && sameGroup && code.group)
      document_.fail(item.range(), fmt::format("`{}` cannot appear in group {} with `{}`: one does not end "
                                               "the other",
                                               name, *code.group, codeText(other.letter, other.tenths)));
  }
}

// "no-feed 11: NO FEEDRATE COMMANDED"
void ControlReader::alarms() {
  for (const TomlTable& table : own("alarms")) {
    const Origin origin = ControlReader::origin(table);
    for (const TomlValue& item : table.require("list", "a list of alarms").items()) {
      const std::string text = item.text();
      const std::size_t blank = text.find(' '), colon = text.find(": ");
      std::uint32_t number = 0;
      bool good = blank < colon && colon != std::string::npos && colon + 2 < text.size() && colon - blank < 6;
      for (std::size_t i = blank + 1; good && i < colon; ++i) {
        good = text[i] >= '0' && text[i] <= '9';
        number = number * 10 + static_cast<std::uint32_t>(text[i] - '0');
      }
      if (!good || number == 0) {
        document_.fail(
            item.range(),
            fmt::format("`{}` is no alarm; `no-feed 11: NO FEEDRATE COMMANDED` is the form", text));
        continue;
      }
      const std::string name = text.substr(0, blank);
      const auto at = std::find(std::begin(kAlarmNames), std::end(kAlarmNames), name);
      if (at == std::end(kAlarmNames)) {
        const std::string near =
            nearestName(name, std::vector<std::string_view>(std::begin(kAlarmNames), std::end(kAlarmNames)));
        document_.fail(item.range(), fmt::format("`{}` is no alarm that Dotek raises{}", name,
                                                 near.empty() ? "" : "; the nearest is `" + near + "`"));
        continue;
      }
      const Alarm alarm = static_cast<Alarm>(at - std::begin(kAlarmNames));
      if (control_.find(alarm) != nullptr)
        document_.fail(item.range(), fmt::format("`{}` is given twice", name));
      else
        control_.alarms.push_back({alarm, number, text.substr(colon + 2), origin.grade, origin.source});
    }
  }
  if (base_ == nullptr) return;
  const auto removed = [&](Alarm alarm) {
    return std::any_of(removedAlarms_.begin(), removedAlarms_.end(),
                       [&](const std::string& one) { return one == "all" || one == alarmName(alarm); });
  };
  for (const AlarmInfo& alarm : base_->alarms)
    if (control_.find(alarm.alarm) == nullptr && !removed(alarm.alarm)) control_.alarms.push_back(alarm);
}

} // namespace dotek::stdlib
