#include "verify/Callers.h"

#include "ir/Match.h"
#include "support/Decimal.h"
#include "verify/Random.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <utility>

namespace dotek::verify {

namespace {

using stdlib::CodeInfo;
using stdlib::Control;
using stdlib::Function;

constexpr double kSameFeed = 1e-6;

// The variable that tells the code in force of the function's group; nothing: programs cannot ask.
bool tellsGroup(const Control& control, Function function) {
  const CodeInfo* code = control.find(function);
  return code != nullptr && code->group && control.variables.modalFirst;
}

bool isCertain(const CodeInfo* code) {
  return code != nullptr && code->grade != "assumed";
}

// How well the control can be asked for what `on` puts in force: not there, asked, or not.
enum class Asked : std::uint8_t { Absent, Yes, No };

Asked asked(const Control& control, Function on, Function off) {
  const CodeInfo* code = control.find(on);
  if (code == nullptr) return Asked::Absent;
  return isCertain(code) && tellsGroup(control, off) ? Asked::Yes : Asked::No;
}

bool asksForShift(const Control& control) {
  const stdlib::SystemVariables& v = control.variables;
  return control.find(Function::LocalShift) != nullptr && v.machine && v.position && v.externalX &&
         v.workOffsetX && v.systemStep != 0 && v.axisStep != 0 && tellsGroup(control, Function::WorkSystem) &&
         asked(control, Function::RotationOn, Function::RotationOff) != Asked::No &&
         asked(control, Function::ScalingOn, Function::ScalingOff) != Asked::No;
}

// A G code of this function.
bool isCode(const ir::Word& word, const Control& control, Function function) {
  const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
  const bool known = code != nullptr && *code >= 0 && *code < 1000;
  const CodeInfo* info =
      known ? control.find('G', static_cast<std::uint32_t>(std::lround(*code * 10))) : nullptr;
  return info != nullptr && info->function == function;
}

// Groups that a bare code puts back, whatever has changed them.
std::set<std::uint32_t> restored(const Control& control) {
  std::set<std::uint32_t> out;
  for (const Function function :
       {Function::Rapid, Function::PlaneXY, Function::Absolute, Function::FeedPerMinute, Function::WorkSystem,
        Function::PathMode, Function::ReturnInitial, Function::PolarOff})
    if (tellsGroup(control, function)) out.insert(static_cast<std::uint32_t>(*control.find(function)->group));
  return out;
}

} // namespace

std::string callerModes(const Control& control, std::uint64_t stream) {
  Random random(stream);
  std::string out;
  const auto oneOf = [&](std::initializer_list<Function> functions) {
    std::vector<const CodeInfo*> codes;
    for (const Function function : functions)
      if (const CodeInfo* code = control.find(function)) codes.push_back(code);
    if (codes.empty()) return;
    out += fmt::format("G{}", numberText(codes[random.below(codes.size())]->tenths / 10.0));
  };
  oneOf({Function::Absolute, Function::Incremental});
  oneOf({Function::PlaneXY, Function::PlaneZX, Function::PlaneYZ});
  oneOf({Function::FeedPerMinute, Function::FeedPerRevolution});
  oneOf({Function::Rapid, Function::Feed});
  return out + "\n";
}

std::vector<BrokenCaller> brokenCallers(const Control& control, bool shiftOfZ,
                                        const std::map<char, double>& starts) {
  std::vector<BrokenCaller> out;
  constexpr std::uint32_t kBeforeSystems = 530, kAfterSystems = 600;
  constexpr double kBeside = 0.02; // mm
  // A code in force that the program can ask for.
  const auto inForce = [&](const CodeInfo* code, std::string alarm) {
    if (code == nullptr || !code->group) return;
    BrokenCaller caller;
    caller.who = fmt::format("with G{} in force", numberText(code->tenths / 10.0));
    caller.alarm = std::move(alarm);
    caller.modal.emplace_back(static_cast<std::uint32_t>(*code->group), code->tenths);
    out.push_back(std::move(caller));
  };
  // Each code of the function, as a program may ask for one of them alone.
  const auto wrong = [&](Function right, Function other, const char* alarm) {
    if (!tellsGroup(control, right)) return;
    for (const CodeInfo& code : control.codes)
      if (code.function == other && code.group == control.find(right)->group) inForce(&code, alarm);
  };
  wrong(Function::Metric, Function::Inch, "NOT METRIC");
  // What is only assumed to exist is asked for by itself.
  const auto off = [&](Function on, Function ends, const char* alarm) {
    const CodeInfo* code = control.find(on);
    if (code != nullptr && tellsGroup(control, isCertain(code) ? ends : on)) inForce(code, alarm);
  };
  off(Function::RotationOn, Function::RotationOff, "ROTATION ACTIVE");
  off(Function::ScalingOn, Function::ScalingOff, "SCALING ACTIVE");
  wrong(Function::CutterCompOff, Function::CutterCompLeft, "CUTTER COMPENSATION ON");
  wrong(Function::CutterCompOff, Function::CutterCompRight, "CUTTER COMPENSATION ON");
  wrong(Function::CannedCycleOff, Function::CannedCycle, "CANNED CYCLE ACTIVE");
  wrong(Function::CannedCycleOff, Function::BackBoring, "CANNED CYCLE ACTIVE");
  if (tellsGroup(control, Function::ToolLengthOff)) {
    inForce(control.find(Function::ToolLengthOff), "TOOL LENGTH NOT ACTIVE");
    out.back().ofToolLength = true;
  }
  const CodeInfo* extended = control.find(Function::ExtendedWorkSystem);
  if (extended != nullptr && tellsGroup(control, Function::WorkSystem)) {
    CodeInfo other = *extended;
    other.group = control.find(Function::WorkSystem)->group;
    inForce(&other, "G54 TO G59 NOT ACTIVE");
    // What the group says besides, whichever code that is.
    for (const std::uint32_t tenths : {kBeforeSystems, kAfterSystems}) {
      other.tenths = tenths;
      inForce(&other, "G54 TO G59 NOT ACTIVE");
      out.back().who = fmt::format("where #{} is {}", *control.variables.modalFirst + *other.group,
                                   numberText(tenths / 10.0));
    }
  }
  // Where the position is asked for as well, it is what that has to be.
  const auto from = [](char axis, double by) {
    return sim::Point3{axis == 'X' ? by : 0, axis == 'Y' ? by : 0, axis == 'Z' ? by : 0};
  };
  for (const auto& [axis, at] : starts)
    if (control.variables.blockEnd)
      for (const double by : {kBeside, -kBeside}) {
        BrokenCaller& caller = out.emplace_back();
        caller.who = fmt::format("from {}{}", axis, numberText(at + by));
        caller.alarm = fmt::format("START NOT AT {}{}", axis, numberText(at));
        caller.away = from(axis, by);
      }
  if (!asksForShift(control)) return out;
  // Beyond 0.01 mm, to either side.
  constexpr std::pair<std::string_view, double> kShifts[] = {{"3.", 3}, {"-0.012", -0.012}, {"0.012", 0.012}};
  const CodeInfo* shift = control.find(Function::LocalShift);
  const std::string code = "G" + numberText(shift->tenths / 10.0);
  for (const char axis : {'X', 'Y', 'Z'}) {
    if (axis == 'Z' && !shiftOfZ) continue;
    for (const auto& [text, by] : kShifts) {
      BrokenCaller caller;
      caller.who = fmt::format("after {} {}{}", code, axis, text);
      caller.alarm = "LOCAL SHIFT ACTIVE";
      caller.shifts = axis;
      caller.blocks = fmt::format("{}{}{}\n", code, axis, text);
      caller.away = from(axis, by);
      out.push_back(std::move(caller));
    }
  }
  return out;
}

bool hasCode(const ir::Program& program, const Control& control, Function function) {
  const auto isIt = [&](const ir::Word& word) { return isCode(word, control, function); };
  return std::any_of(program.body.begin(), program.body.end(), [&](const ir::ProgramStatement& statement) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    return block != nullptr && std::any_of(block->words.begin(), block->words.end(), isIt);
  });
}

bool takesNoOffset(const ir::Program& program, const Control& control) {
  for (const ir::ProgramStatement& statement : program.body) {
    const bool jumps = ir::match(
        statement,
        [](const ir::OneOf<ir::Jump, ir::Branch, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Exit,
                           ir::Raise> auto&) { return true; },
        [](const ir::OneOf<ir::Label, ir::Store, ir::Comment, ir::NcBlock, ir::Call, ir::Notice, ir::Port,
                           ir::Print, ir::NameVariables> auto&) { return false; });
    if (jumps) return false;
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    const auto takes = [&](const ir::Word& word) { return isCode(word, control, Function::ToolLengthPlus); };
    const auto none = [](const ir::Word& word) {
      const double* number = word.address == 'H' ? ir::constantValue(word.value) : nullptr;
      return number != nullptr && *number <= 0;
    };
    if (std::any_of(block->words.begin(), block->words.end(), takes) &&
        std::any_of(block->words.begin(), block->words.end(), none))
      return true;
  }
  return false;
}

std::vector<OtherCaller> otherCallers(const ir::Program& posted, const Control& control, const Entry& entry,
                                      std::uint64_t stream) {
  constexpr std::uint32_t kFirst = 54;
  std::vector<OtherCaller> out;
  const auto systems = static_cast<std::uint32_t>(entry.zeros.size());
  if (hasCode(posted, control, Function::WorkSystem) ||
      hasCode(posted, control, Function::ExtendedWorkSystem)) {
    Random random(stream);
    OtherCaller& other = out.emplace_back();
    other.entry = entry;
    const auto beside = static_cast<std::uint32_t>(1 + random.below(systems - 1));
    other.entry.system = kFirst + (entry.system - kFirst + beside) % systems;
    other.entry.start =
        entry.start + entry.zeros[entry.system - kFirst] - entry.zeros[other.entry.system - kFirst];
    other.who = fmt::format("under G{}", other.entry.system);
  }
  if (!hasCode(posted, control, Function::ToolLengthPlus)) return out;
  const auto underOffset = [&](std::uint32_t number, std::string who) {
    OtherCaller& other = out.emplace_back();
    other.entry = entry;
    other.entry.otherOffset = number;
    other.who = std::move(who);
  };
  if (control.find(Function::ToolLengthOff) != nullptr) underOffset(0, "under G49");
  const std::uint32_t number = entry.toolOffset == 1 ? 2 : 1;
  if (control.variables.toolCount >= static_cast<int>(number))
    underOffset(number, fmt::format("under G43 H{}", number));
  return out;
}

std::vector<OtherCaller> otherModes(const Control& control, const Entry& entry) {
  std::vector<OtherCaller> out;
  for (const Function function : {Function::Incremental, Function::FeedPerRevolution, Function::PlaneZX,
                                  Function::PlaneYZ, Function::Feed}) {
    const CodeInfo* const code = control.find(function);
    if (code == nullptr) continue;
    OtherCaller& other = out.emplace_back();
    other.entry = entry;
    other.ofModes = true;
    other.who = fmt::format("under G{}", numberText(code->tenths / 10.0));
    other.entry.blocks += fmt::format("G{}\n", numberText(code->tenths / 10.0));
  }
  return out;
}

std::optional<Entry> withExternalOffset(const Control& control, const Entry& entry) {
  const stdlib::SystemVariables& v = control.variables;
  if (!v.externalX || v.axisStep == 0) return std::nullopt;
  constexpr sim::Point3 kOffset{0.37, -0.23, 0.41};
  Entry out = entry;
  for (sim::Point3& zero : out.zeros)
    zero = zero - kOffset;
  // It comes into force where the start has been reached.
  out.start = out.start + kOffset;
  const double along[] = {kOffset.x, kOffset.y, kOffset.z};
  for (int axis = 0; axis < 3; ++axis)
    out.variables.emplace_back(static_cast<std::uint32_t>(*v.externalX + axis * v.axisStep), along[axis]);
  return out;
}

std::vector<ModeInForce> modesInForce(const Control& source, const Control& target) {
  std::vector<ModeInForce> out;
  const auto text = [](const CodeInfo& code) { return "G" + numberText(code.tenths / 10.0); };
  for (const Function function :
       {Function::Incremental, Function::FeedPerRevolution, Function::PlaneZX, Function::PlaneYZ,
        Function::Feed, Function::CutterCompLeft, Function::CannedCycle}) {
    const CodeInfo *const one = source.find(function), *const other = target.find(function);
    if (one == nullptr || other == nullptr) continue;
    ModeInForce mode{"under " + text(*one), {}, {}};
    // What would move otherwise is only read.
    const bool readOnly = function == Function::CutterCompLeft || function == Function::CannedCycle;
    if (readOnly && (!one->group || !other->group)) continue;
    if (readOnly) {
      mode.source.modal.emplace_back(static_cast<std::uint32_t>(*one->group), one->tenths);
      mode.target.modal.emplace_back(static_cast<std::uint32_t>(*other->group), other->tenths);
    } else {
      mode.source.blocks = text(*one) + "\n";
      mode.target.blocks = text(*other) + "\n";
    }
    out.push_back(std::move(mode));
  }
  return out;
}

std::string whyNotPutBack(const Control& control, const Record& ran, const Record* source) {
  const std::set<std::uint32_t> groups = restored(control);
  const CodeInfo* plane = control.find(Function::PlaneXY);
  for (std::uint32_t group = 1; group < ran.modalAfter.size(); ++group) {
    const std::uint32_t before = ran.modalBefore[group], after = ran.modalAfter[group];
    if (before == after) continue;
    // Under G68, which stays, no other plane may be chosen.
    if (ran.turn && plane != nullptr && plane->group == static_cast<int>(group) && after == plane->tenths)
      continue;
    if (!groups.contains(group) &&
        (!control.variables.modalFirst || (source != nullptr && source->modalAfter[group] == after)))
      continue;
    return fmt::format("called under G{} it leaves G{} of group {}", numberText(before / 10.0),
                       numberText(after / 10.0), group);
  }
  const CodeInfo* motion = control.find(Function::Rapid);
  if (ran.motionOfMacro && tellsGroup(control, Function::Rapid))
    return fmt::format("called under G{} it leaves what a macro has put in force",
                       numberText(ran.modalBefore[static_cast<std::size_t>(*motion->group)] / 10.0));
  if (control.variables.modalFeed && ran.feedOfMacro)
    return fmt::format("called under F{} it leaves what a macro has put in force",
                       numberText(ran.feedBefore));
  if (control.variables.modalFeed && std::abs(ran.feedBefore - ran.feedAfter) > kSameFeed)
    return fmt::format("called under F{} it leaves F{}", numberText(ran.feedBefore),
                       numberText(ran.feedAfter));
  return "";
}

bool showsAlarm(std::string_view shown, std::string_view text, std::size_t length) {
  return !shown.empty() && (shown == text || (text.size() > length && text.starts_with(shown)));
}

} // namespace dotek::verify
