#include "stdlib/Control.h"

#include "stdlib/DataFiles.h"
#include "stdlib/Toml.h"
#include "support/NearestName.h"

#include <algorithm>
#include <cmath>
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

// What macro statements can compute; ATAN in the forms that exist.
constexpr std::string_view kMacroFunctions[] = {
    "ABS", "ACOS", "ADP", "ASIN", "ATAN", "ATAN[y]", "ATAN[y]/[x]", "ATAN[y,x]", "BCD", "BIN", "COS", "EXP",
    "FIX", "FUP",  "LN",  "MOD",  "POW",  "ROUND",   "SIN",         "SQRT",      "TAN", "AND", "OR",  "XOR"};

// More than any control has; checks compare each with each.
constexpr std::size_t kMostCodes = 2000;
constexpr std::size_t kMostRanges = 100;

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

// The letter of codes with this meaning; 0: either.
char letterOf(Function function) {
  if (function == Function::Other || function == Function::ProbeOn || function == Function::ProbeOff)
    return 0;
  return function >= Function::Stop ? 'M' : 'G';
}

std::string codeText(char letter, std::uint32_t tenths) {
  return tenths % 10 == 0 ? fmt::format("{}{}", letter, tenths / 10)
                          : fmt::format("{}{}.{}", letter, tenths / 10, tenths % 10);
}

class ControlReader {
public:
  explicit ControlReader(const TomlDocument& document) : document_(document), root_(document.root()) {}

  Control read() {
    control_.title = root_.require("title", "what lists print").text();
    decimal();
    words();
    language();
    common();
    readOnly();
    alarm();
    programs();
    for (const TomlTable& table : root_.require("codes", "tables of G and M codes").tables())
      codes(table);
    motion();
    alarms();
    variables();
    return std::move(control_);
  }

private:
  struct Origin {
    std::string grade, source;
  };
  static Origin origin(const TomlTable& table) {
    Origin out;
    out.grade = table.require("grade", "documented, observed, assumed or inferred")
                    .choice({"documented", "observed", "assumed", "inferred"});
    out.source = table.require("source", "where the fact comes from").text();
    return out;
  }
  static std::uint32_t whole(const TomlTable& table, std::string_view key, std::string_view what,
                             std::int64_t least, std::int64_t most) {
    return static_cast<std::uint32_t>(table.require(key, what).integer(least, least, most));
  }

  void decimal() {
    const TomlTable table = section("decimal", "how a number without a point is read");
    const std::string mode =
        table.require("mode", "increment or calculator").choice({"increment", "calculator"}, "calculator");
    control_.decimal = mode == "increment" ? DecimalMode::Increment : DecimalMode::Calculator;
    control_.decimalGrade = origin(table).grade;
  }

  void words() {
    const TomlTable table = section("words", "how many digits a word takes");
    origin(table);
    const TomlValue increment = table.require("increment", "the least input increment in mm");
    control_.increment = increment.number();
    control_.decimals =
        static_cast<int>(whole(table, "decimals", "the most digits behind the point, mm", 0, 6));
    control_.integerDigits =
        static_cast<int>(whole(table, "integer_digits", "the most digits before the point", 1, 9));
    if (const TomlValue digits = table.value("digits"))
      control_.digits = static_cast<std::uint32_t>(digits.integer(8, 1, 99));
    if (std::abs(control_.increment * std::pow(10.0, control_.decimals) - 1) > 1e-9)
      document_.fail(increment.range(), fmt::format("an increment of {} is not one unit of decimal {}",
                                                    control_.increment, control_.decimals));
  }

  void language() {
    const TomlTable table = section("language", "what macro statements can say");
    origin(table);
    control_.ifThen = table.require("if_then", "true or false").flag();
    control_.joinedConditions = table.require("joined_conditions", "true or false").flag();
    control_.thenGoto = table.value("then_goto").flag();
    control_.bareFunctions = table.value("bare_functions").flag();
    control_.bracketDepth = whole(table, "bracket_depth", "how deep brackets nest", 1, 99);
    control_.locals = whole(table, "locals", "the greatest number of a local variable", 1, 99);
    control_.macroLevels = whole(table, "macro_levels", "how deep G65 nests", 1, 99);
    for (const TomlValue& item : table.require("functions", "a list of names").items()) {
      const std::string name = item.text();
      if (std::find(std::begin(kMacroFunctions), std::end(kMacroFunctions), name) ==
          std::end(kMacroFunctions)) {
        const std::string near = nearestName(
            name, std::vector<std::string_view>(std::begin(kMacroFunctions), std::end(kMacroFunctions)));
        document_.fail(item.range(), fmt::format("`{}` is no function of macro statements{}", name,
                                                 near.empty() ? "" : "; the nearest is `" + near + "`"));
      }
      if (!control_.functions.insert(name).second)
        document_.fail(item.range(), fmt::format("`{}` is given twice", name));
    }
    for (const std::string& name : control_.functions) {
      if (name.starts_with("ATAN[") && !control_.functions.contains("ATAN"))
        document_.fail(table.value("functions").range(),
                       fmt::format("`{}` is a form of `ATAN`, which is missing", name));
    }
  }

  void common() {
    for (const TomlTable& table : root_.require("common", "tables of common variables").tables()) {
      origin(table);
      if (control_.common.size() == kMostRanges)
        document_.fail(table.range(), fmt::format("more than {} ranges", kMostRanges));
      VariableRange range;
      range.first = whole(table, "first", "a variable number", 1, 999999);
      range.last = whole(table, "last", "a variable number", 1, 999999);
      range.kept = table.require("kept", "true or false").flag();
      if (range.first > range.last)
        document_.fail(table.range(), fmt::format("#{} to #{} is no range", range.first, range.last));
      if (range.first <= control_.locals)
        document_.fail(table.range(), fmt::format("#{} is a local variable", range.first));
      for (const VariableRange& other : control_.common) {
        if (range.first <= other.last && other.first <= range.last)
          document_.fail(table.range(), fmt::format("#{} to #{} overlaps #{} to #{}", range.first, range.last,
                                                    other.first, other.last));
      }
      control_.common.push_back(range);
    }
  }

  void readOnly() {
    for (const TomlTable& table : root_.value("read_only").tables()) {
      origin(table);
      if (control_.readOnly.size() == kMostRanges)
        document_.fail(table.range(), fmt::format("more than {} ranges", kMostRanges));
      VariableRange range;
      range.first = whole(table, "first", "a variable number", 1000, 999999);
      range.last = whole(table, "last", "a variable number", 1000, 999999);
      if (range.first > range.last)
        document_.fail(table.range(), fmt::format("#{} to #{} is no range", range.first, range.last));
      control_.readOnly.push_back(range);
    }
  }

  void alarm() {
    const TomlTable table = section("alarm", "what #3000 takes");
    origin(table);
    control_.alarmFirst = whole(table, "first", "the least number", 0, 9999);
    control_.alarmLast = whole(table, "last", "the greatest number", 0, 9999);
    control_.alarmLength = whole(table, "length", "characters of a message", 1, 999);
    if (control_.alarmFirst > control_.alarmLast)
      document_.fail(table.range(),
                     fmt::format("{} to {} is no range", control_.alarmFirst, control_.alarmLast));
  }

  void programs() {
    const TomlTable table = section("programs", "numbers of programs and blocks");
    origin(table);
    control_.programLast = whole(table, "last", "the greatest O number", 1, 99999999);
    control_.sequenceLast = whole(table, "last_sequence", "the greatest N number of a GOTO", 1, 99999999);
    control_.colonNames = table.value("colon").flag();
    control_.programNames = table.value("names").flag();
  }

  void codes(const TomlTable& table) {
    const Origin origin = ControlReader::origin(table);
    std::optional<int> group;
    if (const TomlValue value = table.value("group")) group = static_cast<int>(value.integer(1, 1, 99));
    for (const TomlValue& item : table.require("list", "a list of codes").items()) {
      if (control_.codes.size() == kMostCodes)
        document_.fail(item.range(), fmt::format("more than {} codes", kMostCodes));
      std::optional<CodeInfo> code = parseCode(item);
      if (!code) continue;
      code->group = group;
      code->grade = origin.grade;
      code->source = origin.source;
      check(*code, item);
      control_.codes.push_back(std::move(*code));
    }
  }

  // "G54.1 extended-work-system: additional work coordinate system"; without a function: other.
  std::optional<CodeInfo> parseCode(const TomlValue& item) const {
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

  void check(const CodeInfo& code, const TomlValue& item) {
    const std::string name = codeText(code.letter, code.tenths);
    if (control_.find(code.letter, code.tenths) != nullptr)
      document_.fail(item.range(), fmt::format("`{}` is given twice", name));
    const char letter = letterOf(code.function);
    if (letter != 0 && letter != code.letter)
      document_.fail(item.range(), fmt::format("`{}` is no {} function, which `{}` is",
                                               functionName(code.function), code.letter, name));
    if (code.letter == 'M' && code.group)
      document_.fail(item.range(),
                     fmt::format("`{}` stands in modal group {}, which holds G codes", name, *code.group));
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
        document_.fail(item.range(), fmt::format("`{}` belongs with `{}` and stands in another group", name,
                                                 codeText(other.letter, other.tenths)));
      if (family != otherFamily && sameGroup && code.group)
        document_.fail(item.range(), fmt::format("`{}` cannot stand in group {} with `{}`: one does not end "
                                                 "the other",
                                                 name, *code.group, codeText(other.letter, other.tenths)));
    }
  }

  void motion() {
    const TomlValue value = root_.value("motion");
    if (!value) return;
    const TomlTable table = value.table();
    origin(table);
    if (const TomlValue tolerance = table.value("arc_tolerance")) {
      control_.arcTolerance = tolerance.number();
      if (*control_.arcTolerance <= 0) document_.fail(tolerance.range(), "`arc_tolerance` is a length in mm");
    }
    if (const TomlValue letter = table.value("repeat"))
      control_.repeatLetter = letter.choice({"K", "L"}, "K").front();
  }

  // "no-feed 11: NO FEEDRATE COMMANDED"
  void alarms() {
    for (const TomlTable& table : root_.value("alarms").tables()) {
      const Origin origin = ControlReader::origin(table);
      for (const TomlValue& item : table.require("list", "a list of alarms").items()) {
        const std::string text = item.text();
        const std::size_t blank = text.find(' '), colon = text.find(": ");
        std::uint32_t number = 0;
        bool good =
            blank < colon && colon != std::string::npos && colon + 2 < text.size() && colon - blank < 6;
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
          const std::string near = nearestName(
              name, std::vector<std::string_view>(std::begin(kAlarmNames), std::end(kAlarmNames)));
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
  }

  void variables() {
    const TomlTable table = section("variables", "system variables");
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
    v.toolCount = static_cast<int>(table.value("tool_count").integer(0, 1, 999));
    v.modalWords = number("modal_words");
    v.toolLength = number("tool_length");
    v.alarm = number("alarm");
    v.timer = number("timer");
    v.hours = number("hours");
    v.message = number("message");
    v.systemStep = static_cast<int>(table.value("system_step").integer(0, 1, 9999));
    v.axisStep = static_cast<int>(table.value("axis_step").integer(0, 1, 9999));
    if (v.workOffsetX && v.systemStep == 0)
      document_.fail(table.value("work_offset_x").range(), "`work_offset_x` stands without `system_step`");
    if ((v.workOffsetX || v.externalX) && v.axisStep == 0)
      document_.fail(table.value(v.workOffsetX ? "work_offset_x" : "external_x").range(),
                     "an offset of X stands without `axis_step`");
    if (v.extendedX && (v.extendedStep == 0 || v.extendedCount == 0))
      document_.fail(table.value("extended_x").range(),
                     "`extended_x` stands without `extended_step` and `extended_count`");
    if ((v.toolWear || v.toolGeometry) && v.toolCount == 0)
      document_.fail(table.value(v.toolWear ? "tool_wear" : "tool_geometry").range(),
                     "tool offsets stand without `tool_count`");
    std::vector<std::pair<std::string_view, int>> blocks;
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
    add("tool_wear", v.toolWear ? std::optional<int>(*v.toolWear + 1) : std::nullopt, v.toolCount);
    add("tool_geometry", v.toolGeometry ? std::optional<int>(*v.toolGeometry + 1) : std::nullopt,
        v.toolCount);
    add("tool_length", v.toolLength, 3);
    add("alarm", v.alarm, 1);
    add("timer", v.timer, 1);
    add("hours", v.hours, 1);
    add("message", v.message, 1);
    if (v.modalFirst) {
      for (const CodeInfo& code : control_.codes)
        if (code.group) blocks.emplace_back("modal_first", *v.modalFirst + *code.group);
    }
    overlaps(table, blocks);
  }

  void overlaps(const TomlTable& table, const std::vector<std::pair<std::string_view, int>>& blocks) const {
    std::map<int, std::string_view> taken;
    for (const auto& [key, number] : blocks) {
      const auto [at, added] = taken.try_emplace(number, key);
      const bool shared = key == "modal_first" && at->second == key; // one group, many codes
      if (!added && !shared)
        document_.fail(
            table.value(key).range(),
            fmt::format("#{} is a variable of `{}` {}", number, at->second,
                        at->second == key ? "twice: its steps meet" : fmt::format("and of `{}`", key)));
      if (control_.isCommon(static_cast<std::uint32_t>(number)))
        document_.fail(table.value(key).range(), fmt::format("#{} is a common variable", number));
    }
  }

  TomlTable section(std::string_view key, std::string_view what) const {
    return root_.require(key, what).table();
  }

  const TomlDocument& document_;
  TomlTable root_;
  Control control_;
};

} // namespace

std::string_view functionName(Function function) {
  return kFunctionNames[static_cast<std::size_t>(function)];
}

std::string_view alarmName(Alarm alarm) {
  return kAlarmNames[static_cast<std::size_t>(alarm)];
}

const AlarmInfo* Control::find(Alarm alarm) const {
  const auto at =
      std::find_if(alarms.begin(), alarms.end(), [&](const AlarmInfo& info) { return info.alarm == alarm; });
  return at == alarms.end() ? nullptr : &*at;
}

const CodeInfo* Control::find(char letter, std::uint32_t tenths) const {
  const auto at = std::find_if(codes.begin(), codes.end(), [&](const CodeInfo& code) {
    return code.letter == letter && code.tenths == tenths;
  });
  return at == codes.end() ? nullptr : &*at;
}

const CodeInfo* Control::find(Function function) const {
  const auto at = std::find_if(codes.begin(), codes.end(),
                               [&](const CodeInfo& code) { return code.function == function; });
  return at == codes.end() ? nullptr : &*at;
}

bool Control::isCommon(std::uint32_t number) const {
  return std::any_of(common.begin(), common.end(), [&](const VariableRange& range) {
    return range.first <= number && number <= range.last;
  });
}

bool Control::isReadOnly(std::uint32_t number) const {
  return std::any_of(readOnly.begin(), readOnly.end(), [&](const VariableRange& range) {
    return range.first <= number && number <= range.last;
  });
}

std::optional<Control> Control::load(const DataFiles& files, std::string_view name) {
  const DataFile* file = files.find("controls", name);
  if (file == nullptr) return std::nullopt;
  const TomlDocument document = TomlDocument::parse(*file);
  Control control = ControlReader(document).read();
  document.finish();
  control.name = name;
  control.origin = file->origin;
  return control;
}

} // namespace dotek::stdlib
