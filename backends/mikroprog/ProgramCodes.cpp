// What codes, tools and speeds of the source become.
#include "backends/mikroprog/ProgramWriter.h"

#include "backends/common/PlainText.h"
#include "ir/Match.h"
#include "support/Decimal.h"
#include "support/Source.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace dotek::backends::mikroprog {

using stdlib::Function;

namespace {

std::string codeText(char letter, double value) {
  return letter + numberText(value);
}

// It is in force until another of its kind: the positions that follow belong to it.
bool goesOn(const stdlib::CodeInfo& code, const stdlib::Control& control) {
  const auto inGroupOf = [&](std::uint32_t tenths) {
    const stdlib::CodeInfo* const other = control.find('G', tenths);
    return other != nullptr && other->group && other->group == code.group;
  };
  return inGroupOf(10) || inGroupOf(800);
}

} // namespace

bool ProgramWriter::code(const ir::Word& word, Parts& parts) {
  const auto value = number(word);
  if (!value) return false;
  const std::string name = codeText('G', *value);
  const stdlib::CodeInfo* const info =
      source_.find('G', static_cast<std::uint32_t>(std::lround(*value * 10)));
  const auto no = [&](const std::string& what, const std::string& instead) {
    cannot(word.range, fmt::format("`{}`: {}", name, what), instead);
    if (info != nullptr && goesOn(*info, source_)) state_.refusedMotion = name;
    return false;
  };
  const auto out = [&](const std::string& why) {
    dropped(word.range, "`" + name + "`", why);
    return true;
  };
  const auto says = [&](const char* text) {
    parts.words.emplace_back(text);
    return true;
  };
  if (info == nullptr)
    return no(fmt::format("it is no code of `{}`", source_.name),
              "leave it out, or name the control it is for");
  switch (info->function) {
  case Function::Rapid:
  case Function::Feed:
  case Function::ArcClockwise:
  case Function::ArcCounterClockwise:
  case Function::Thread:
  case Function::TurningCycle:
  case Function::FacingCycle:
    if (state_.motion != info->function) state_.cycleEnd = {}, state_.cycleTaper = 0;
    state_.refusedMotion.clear();
    state_.motion = info->function;
    return true;
  case Function::ThreadingCycle:
    state_.motion = info->function; // of the passes that follow
    return no("how the thread runs out of the cycle is a parameter of its control",
              "write its passes as G32");
  case Function::PlaneXY: state_.plane = info->function; return says("G17");
  case Function::PlaneZX: state_.plane = info->function; return says("G18");
  case Function::PlaneYZ: state_.plane = info->function; return says("G19");
  case Function::Metric: return out("all lengths are millimetres here");
  case Function::Inch: return no("all lengths are millimetres here", "write the program in millimetres");
  case Function::CutterCompOff: return says("G40");
  case Function::CutterCompLeft: return says("G41");
  case Function::CutterCompRight: return says("G42");
  case Function::ToolLengthOff:
    return state_.lengthOn
               ? no("M6 puts the correction of a tool in force, and nothing ends it", "leave it out")
               : out("no length is in force before M6");
  case Function::ToolLengthPlus: return length(word, name);
  case Function::CannedCycleOff: state_.refusedMotion.clear(); return out("cycles are of one block here");
  case Function::ReturnInitial: return out("cycles come back to where they begin");
  case Function::ModalCallOff:
  case Function::RotationOff:
  case Function::PolarOff:
  case Function::MirrorOff:
  case Function::ScalingOff: return out("this control has nothing that it would end");
  case Function::Absolute: state_.incremental = false; return out("coordinates are written absolute");
  case Function::Incremental: state_.incremental = true; return out("coordinates are written absolute");
  case Function::FeedPerMinute: unit(false); return says("G94");
  case Function::FeedPerRevolution: unit(true); return says("G95");
  case Function::SurfaceSpeedOff: return out("S counts turns a minute here until G96");
  case Function::SurfaceSpeedOn:
    return no("here it has no surface speed, and takes the present speed and diameter for its base (Q27)",
              "write G97 with the speed of each diameter");
  case Function::WorkSystem:
    if (info->tenths != 540)
      return no("here it is a stored shift or nothing, and a program has one active system",
                "write all coordinates in one system, that of G54");
    return out("its zero is the active system, which the operator sets; here it would be stored shift 3");
  case Function::SetPosition:
    return find('S') != nullptr
               ? clamp(word, name)
               : no("what it sets lasts here until the reference run", "write the coordinates in one system");
  case Function::Dwell:
  case Function::ReferenceReturn:
    if (once_ != Function::Other) return no("two functions of one block want its words", "write two blocks");
    once_ = info->function;
    return true;
  default:
    return no("no function of this control does it that a source describes",
              "write its moves as blocks (`dotek flatten` writes those of a program that runs)");
  }
}

// What an F of the other unit is then is not certain.
void ProgramWriter::unit(bool perRevolution) {
  if (state_.perRevolution != perRevolution) {
    feedDropped();
    state_.feed.reset();
    state_.feedLost = true;
  }
  state_.perRevolution = perRevolution;
}

// G50 S: without G96, and where no S is above it, it changes nothing.
bool ProgramWriter::clamp(const ir::Word& word, const std::string& name) {
  const auto most = take('S');
  if (!most) return false;
  const auto no = [&](const std::string& why, const std::string& instead) {
    cannot(word.range,
           fmt::format("`{}`: the greatest speed is the A of G96 here, and G50 ends a shift; {}", name, why),
           instead);
    return false;
  };
  for (const char axis : std::string_view("XYZUVW"))
    if (find(axis) != nullptr) return no("coordinates are set in the same block", "write two blocks");
  for (const ir::Program& program : file_.programs)
    for (const ir::ProgramStatement& statement : program.body) {
      const auto* const block = std::get_if<ir::NcBlock>(&statement.node);
      if (block == nullptr) continue;
      const ir::Word* speed = nullptr;
      bool clamps = false;
      for (const ir::Word& one : block->words) {
        if (one.address == 'S') speed = &one;
        const stdlib::CodeInfo* const code = one.address == 'G' ? codeOf(one) : nullptr;
        if (code != nullptr && code->function == Function::SurfaceSpeedOn)
          return no("this program has constant surface speed",
                    "write G97 with the speed of each diameter, and leave it out");
        clamps = clamps || (code != nullptr && code->function == Function::SetPosition);
      }
      if (speed == nullptr || clamps) continue;
      const double* const value = ir::constantValue(speed->value);
      if (value == nullptr || *value > *most)
        return no("an S of the program is above it, or computed",
                  "write the speeds that the spindle may have, and leave it out");
    }
  dropped(word.range, fmt::format("`{} S{}`", name, numberText(*most)),
          "no S of the program is above it, and there is no constant surface speed");
  return true;
}

bool ProgramWriter::length(const ir::Word& word, const std::string& name) {
  const auto h = take('H');
  if (!h || !state_.tool || *h != *state_.tool) {
    cannot(word.range,
           fmt::format("`{}`: M6 puts the correction of its own tool in force, and no other can be", name),
           "name the offset of the tool in the spindle");
    return false;
  }
  state_.lengthOn = true;
  dropped(word.range, fmt::format("`{} H{}`", name, numberText(*h)),
          "M6 puts the correction of the tool in force");
  return true;
}

void ProgramWriter::auxiliary(const ir::Word& word, Parts& parts) {
  const auto value = number(word);
  if (!value) return;
  const std::string name = codeText('M', *value);
  const stdlib::CodeInfo* const info =
      source_.find('M', static_cast<std::uint32_t>(std::lround(*value * 10)));
  const auto no = [&](const std::string& what, const std::string& instead) {
    cannot(word.range, fmt::format("`{}`: {}", name, what), instead);
  };
  if (info == nullptr)
    return no(fmt::format("it is no code of `{}`", source_.name),
              "leave it out, or name the control it is for");
  const auto another = [&](bool& one) {
    if (std::exchange(one, true)) no("two codes for one thing are in the block", "write two blocks");
  };
  switch (info->function) {
  case Function::SpindleClockwise:
  case Function::SpindleCounterClockwise:
  case Function::SpindleOff: another(parts.spindle); break;
  case Function::CoolantFlood:
  case Function::CoolantOff: another(parts.coolant); break;
  default: break;
  }
  if (refused_) return;
  switch (info->function) {
  case Function::Stop: parts.after.emplace_back("M0"); return;
  case Function::ProgramEnd:
    parts.after.emplace_back("M30");
    ended_ = programEnded_ = true;
    return;
  case Function::SpindleClockwise:
  case Function::SpindleCounterClockwise: {
    const auto speed = find('S') != nullptr ? take('S') : state_.speed;
    if (!speed)
      return no("the speed is not known before it, and M3 and M4 take it here", "write S in the block");
    state_.speed = speed;
    parts.before.push_back(
        fmt::format("{} S{}", info->function == Function::SpindleClockwise ? "M3" : "M4", shown(*speed)));
    return;
  }
  case Function::SpindleOff: parts.after.emplace_back("M5"); return;
  case Function::CoolantFlood: parts.before.emplace_back("M8"); return;
  case Function::CoolantOff: parts.after.emplace_back("M9"); return;
  case Function::CoolantMist: return no("there is one coolant here", "write M8");
  case Function::OptionalStop:
    return no("which field of the operator it asks is not certain (Q14)", "write M0, or leave it out");
  case Function::ToolChange: {
    const auto number = find('T') != nullptr ? take('T')
                        : state_.tool        ? std::optional<double>(*state_.tool)
                                             : std::nullopt;
    if (!number) return no("which tool comes is not known", "write T in the block");
    return change(word.range, *number, parts);
  }
  default:
    return no("it has no counterpart here, or another meaning",
              "leave it out, or write what it does here by hand");
  }
}

void ProgramWriter::change(SourceRange range, double number, Parts& parts) {
  const stdlib::MikroprogAddress* const place = control_.function("tool-change").find('T');
  if (number < 1 || number != std::floor(number) ||
      (place != nullptr && place->most && number > *place->most))
    return cannot(range, fmt::format("tool {} is none of this machine", numberText(number)),
                  "number the tools as its turret does");
  // The tips of two tools differ, and so does where the new one is.
  if (state_.tool != number) {
    if (source_.turning) state_.at = {}, state_.cycleEnd = {};
    state_.at[2].reset();
  }
  state_.tool = static_cast<std::uint32_t>(number);
  state_.lengthOn = false;
  parts.before.push_back(fmt::format("M6 T{}", state_.tool.value()));
  parts.order = range;
}

void ProgramWriter::tool(const ir::Word& word, Parts& parts) {
  const auto value = take('T');
  if (!value) return;
  double offsets = 1;
  for (std::uint32_t i = 0; i < source_.turning->offsetDigits; ++i)
    offsets *= 10;
  const double number = std::floor(*value / offsets), offset = *value - number * offsets;
  if (*value < offsets || offset != number)
    return cannot(word.range,
                  fmt::format("`T{}`: M6 takes the correction of its own tool, and no other or none",
                              numberText(*value)),
                  "name the offset of the same number");
  change(word.range, number, parts);
}

void ProgramWriter::speed(Parts& parts) {
  if (taken_.find('S') != std::string::npos) return;
  const auto speed = take('S');
  if (!speed) return;
  state_.speed = speed;
  parts.before.push_back("S" + shown(*speed));
}

} // namespace dotek::backends::mikroprog
