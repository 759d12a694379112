#include "sim/machine/CodeTable.h"

#include <algorithm>

namespace dotek::sim {
namespace {

using stdlib::Function;

std::uint64_t keyOf(char letter, std::uint64_t tenths) {
  return static_cast<std::uint64_t>(static_cast<unsigned char>(letter)) << 40 | tenths;
}

struct Effect {
  std::uint8_t slot = kScratch, value = 0, flags = Code::Long;
};

Effect effectOf(const stdlib::CodeInfo& info) {
  switch (info.function) {
  case Function::Rapid: return {kMotion, kRapid, Code::Plain};
  case Function::Feed: return {kMotion, kFeed, Code::Plain};
  case Function::ArcClockwise: return {kMotion, kArcClockwise, Code::Plain};
  case Function::ArcCounterClockwise: return {kMotion, kArcCounterClockwise, Code::Plain};
  case Function::Thread: return {kMotion, kThread, Code::Long};
  case Function::TurningCycle: return {kMotion, kTurningCycle, Code::Long};
  case Function::ThreadingCycle: return {kMotion, kThreadingCycle, Code::Long};
  case Function::FacingCycle: return {kMotion, kFacingCycle, Code::Long};
  case Function::SurfaceSpeedOn: return {kSurface, 1, Code::Long};
  case Function::SurfaceSpeedOff: return {kSurface, 0, Code::Long};
  case Function::PlaneXY: return {kPlane, 0, Code::Plain};
  case Function::PlaneZX: return {kPlane, 1, Code::Plain};
  case Function::PlaneYZ: return {kPlane, 2, Code::Plain};
  case Function::Absolute: return {kDistance, 0, Code::Plain};
  case Function::Incremental: return {kDistance, 1, Code::Plain};
  case Function::Metric: return {kUnits, 0, Code::Long};
  case Function::Inch: return {kUnits, 1, Code::Long};
  case Function::FeedPerMinute: return {kFeedMode, 0, Code::Long};
  case Function::FeedPerRevolution: return {kFeedMode, 1, Code::Long};
  case Function::CutterCompOff: return {kComp, 0, Code::Long};
  case Function::CutterCompLeft: return {kComp, 1, Code::Long};
  case Function::CutterCompRight: return {kComp, 2, Code::Long};
  case Function::ToolLengthOff: return {kLength, 0, Code::Long};
  case Function::ToolLengthPlus: return {kLength, 1, Code::Long};
  case Function::ToolLengthMinus: return {kLength, 2, Code::Long};
  case Function::WorkSystem:
    return {kSystem, static_cast<std::uint8_t>((info.tenths - 540) / 10), Code::Long};
  case Function::ExtendedWorkSystem: return {kSystem, kExtended, Code::Long};
  case Function::CannedCycleOff: return {kCanned, 0, Code::Long};
  case Function::CannedCycle: return {kCanned, 1, Code::Long};
  case Function::BackBoring: return {kCanned, 2, Code::Long};
  case Function::ReturnInitial: return {kReturn, 0, Code::Long};
  case Function::ReturnR: return {kReturn, 1, Code::Long};
  case Function::Dwell:
  case Function::Skip:
  case Function::DataInput:
  case Function::LocalShift:
  case Function::SetPosition:
  case Function::RotationOn:
  case Function::MachineCoordinates:
  case Function::ReferenceReturn:
  case Function::SecondReferenceReturn:
  case Function::ContourFinish:
  case Function::ContourRough:
  case Function::PeckAlongZ:
  case Function::PeckAlongX:
  case Function::ThreadPasses:
  case Function::MacroCall:
  case Function::ModalCall: return {kScratch, 0, Code::Long | Code::OneShot};
  default: return {};
  }
}

} // namespace

CodeTable::CodeTable(const stdlib::Control& control) {
  codes_.emplace_back();
  for (const stdlib::CodeInfo& info : control.codes) {
    Code code;
    code.function = info.function;
    code.tenths = info.tenths;
    if (info.group && *info.group < kGroups) code.group = static_cast<std::uint8_t>(*info.group);
    if (info.letter == 'G') {
      const Effect effect = effectOf(info);
      code.slot = effect.slot;
      code.value = effect.value;
      code.flags = effect.flags;
    } else {
      code.flags = Code::Long;
    }
    const auto index = static_cast<std::uint16_t>(codes_.size());
    codes_.push_back(code);
    sorted_.emplace_back(keyOf(info.letter, info.tenths), index);
    if (info.letter == 'G' && info.tenths < kDirect) direct_[info.tenths] = index;
  }
  std::sort(sorted_.begin(), sorted_.end());
}

std::uint16_t CodeTable::far(char letter, std::uint32_t tenths) const {
  const auto at = std::lower_bound(sorted_.begin(), sorted_.end(),
                                   std::pair<std::uint64_t, std::uint16_t>(keyOf(letter, tenths), 0));
  return at != sorted_.end() && at->first == keyOf(letter, tenths) ? at->second : std::uint16_t{0};
}

const Code* CodeTable::find(Function function) const {
  const auto at = std::find_if(codes_.begin() + 1, codes_.end(),
                               [&](const Code& code) { return code.function == function; });
  return at == codes_.end() ? nullptr : &*at;
}

} // namespace dotek::sim
