#include "tests/oracle/VendorMacros.h"

#include "sim/machine/Arguments.h"
#include "stdlib/MacroLimits.h"
#include "stdlib/ReadCall.h"
#include "tests/oracle/VendorRun.h"

#include <fmt/format.h>
#include <vector>

namespace dotek::oracle {

using namespace dotek::sim;

using stdlib::Intent;

bool VendorMacros::run(Machine& machine, std::uint32_t program, std::span<const double> locals) {
  const GivenLetters given = givenLetters(locals);
  if (given.unlettered != 0)
    return machine.inconclusive(fmt::format("P{} of `{}`: what #{} of the call means is not known", program,
                                            set_.name, given.unlettered));
  const stdlib::CallReading reading = stdlib::readCall(set_, program, given.letters);
  using stdlib::CallRefusal;
  switch (reading.refusal) {
  case CallRefusal::None: break;
  case CallRefusal::Excluded:
    return machine.raiseUnnumbered(reading.excluded->text.empty() ? stdlib::refusalText(reading)
                                                                  : reading.excluded->text);
  case CallRefusal::UnknownProgram:
  case CallRefusal::RepeatedLetter:
  case CallRefusal::UnknownLetter:
  case CallRefusal::Missing:
  case CallRefusal::Ambiguous:
    return machine.inconclusive(stdlib::refusalText(reading) + "; what the macro does then is not known",
                                reading.letter());
  }
  const auto targets = [&](ir::Axis axis) {
    const stdlib::MacroArgument* const target = reading.signature->find(stdlib::ArgumentRole::Target, axis);
    const std::uint32_t local = target == nullptr ? 0 : stdlib::localOf(target->letter);
    return target != nullptr && local < locals.size() && !isNull(locals[local]);
  };
  if (memory_.touchesApart && reading.signature->intent == Intent::InnerCorner && targets(ir::Axis::X) &&
      targets(ir::Axis::Y) && !targets(ir::Axis::Z))
    return runApart(machine, *reading.signature, locals);
  return VendorRun(machine, set_, control_, *reading.signature, locals, memory_).run();
}

bool VendorMacros::runApart(Machine& machine, const stdlib::MacroSignature& signature,
                            std::span<const double> locals) {
  const Position start = machine.position();
  for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y}) {
    const ir::Axis other = axis == ir::Axis::X ? ir::Axis::Y : ir::Axis::X;
    std::vector<double> given(locals.begin(), locals.end());
    if (const stdlib::MacroArgument* target = signature.find(stdlib::ArgumentRole::Target, other))
      if (const std::uint32_t local = stdlib::localOf(target->letter); local < given.size())
        given[local] = kNull;
    if (!VendorRun(machine, set_, control_, signature, given, memory_).run()) return false;
    if (machine.watcher() != nullptr) machine.watcher()->touchedApart();
    if (!machine.travelTo(start)) return false;
  }
  return true;
}

const stdlib::MacroArgument* VendorRun::argument(Role role, ir::Axis axis) const {
  const stdlib::MacroArgument* found = signature_.find(role, axis);
  if (found == nullptr) return nullptr;
  const std::uint32_t local = stdlib::localOf(found->letter);
  return local < locals_.size() && !isNull(locals_[local]) ? found : nullptr;
}

std::optional<double> VendorRun::value(Role role, ir::Axis axis) const {
  const stdlib::MacroArgument* found = argument(role, axis);
  return found == nullptr ? std::nullopt : std::optional<double>(locals_[stdlib::localOf(found->letter)]);
}

bool VendorRun::notKnown(std::string_view what, char letter) {
  return machine_.inconclusive(
      fmt::format("P{} of `{}`, {}: {}", signature_.program, set_.name, signature_.title, what), letter);
}

bool VendorRun::meaningless(std::string_view what, char letter) {
  return machine_.meaningless(
      fmt::format("P{} of `{}`, {}: {}", signature_.program, set_.name, signature_.title, what), letter);
}

bool VendorRun::passes(std::string_view what, char letter) {
  if (!memory_.passUnstated) return notKnown(what, letter);
  if (MotionWatcher* const watcher = machine_.watcher(); watcher != nullptr)
    watcher->callUnstated(
        fmt::format("P{} of `{}`, {}: {}", signature_.program, set_.name, signature_.title, what), locals_);
  return true;
}

bool VendorRun::leave() {
  writeResults();
  machine_.forgetMotion(std::nullopt);
  return true;
}

std::string_view macroAlarmText(stdlib::MacroAlarm alarm) {
  using stdlib::MacroAlarm;
  switch (alarm) {
  case MacroAlarm::PathObstructed:
    return "the probe touched something on its path where nothing was expected";
  case MacroAlarm::NoFeed: return "no feed is given for the protected move";
  case MacroAlarm::ProbeOpen: return "the probe is deflected before it moves";
  case MacroAlarm::ProbeFail: return "the probe met nothing on its path to the surface";
  case MacroAlarm::OutOfTolerance: return "the size is out of its tolerance";
  case MacroAlarm::OutOfPosition: return "the feature is out of its position tolerance";
  case MacroAlarm::OutOfAngle: return "the angle is out of its tolerance";
  case MacroAlarm::UpperLimit: return "the error is larger than the call allows";
  }
  return "";
}

bool VendorRun::alarm(stdlib::MacroAlarm alarm) {
  const stdlib::MacroAlarmInfo* info = set_.find(alarm);
  if (info != nullptr && info->number) return machine_.raise(*info->number, info->text);
  return machine_.raiseUnnumbered(info == nullptr ? macroAlarmText(alarm) : std::string_view(info->text));
}

void VendorRun::sayOnce(std::string_view action, const std::string& text) {
  if (machine_.trace() == nullptr) return;
  if (memory_.said.insert(std::string(action) + " " + text).second) machine_.remark(action, text);
}

bool VendorRun::run() {
  if (signature_.intent == Intent::ProbeOn || signature_.intent == Intent::ProbeOff) {
    machine_.switchProbe(signature_.intent == Intent::ProbeOn);
    if (const auto print = value(Role::Print)) machine_.remark("print", fmt::format("{:g}", *print));
    machine_.forgetMotion(std::nullopt);
    writeResults();
    return true;
  }
  if (!begin()) return false;
  return passed_ ? leave() : features() && finish();
}

// What the machine has to be like, and what of the call is known.
bool VendorRun::begin() {
  if (!signature_.unknown.empty()) {
    if (!passes(signature_.unknown + " is in no source")) return false;
    passed_ = true;
  }
  for (const stdlib::MacroArgument& one : signature_.arguments) {
    const std::uint32_t local = stdlib::localOf(one.letter);
    const bool given = local < locals_.size() && !isNull(locals_[local]);
    if (given && !passed_ && (!one.unknown.empty() || one.role == Role::Unstated)) {
      if (!passes((one.unknown.empty() ? "what the argument means" : one.unknown) + " is in no source",
                  one.letter))
        return false;
      passed_ = true;
    }
    if (given && isUnknown(locals_[local])) return notKnown("the value is not known", one.letter);
    if (given && stdlib::isLimit(one.role) && locals_[local] < 0)
      return meaningless("what it does with a limit below 0 is in no source", one.letter);
  }
  if (machine_.mode(kDistance) != 0) return notKnown("what it does under G91 is in no source");
  if (machine_.mode(kUnits) != 0)
    return notKnown(
        "its work is stated in millimetres, and Dotek does it under G21 alone: run the program in "
        "millimetres, or the macro's own text (`--programs DIR`)");
  if (machine_.mode(kComp) != 0 || machine_.offsetsPath() || machine_.mode(kCanned) != 0)
    return notKnown("what it does under cutter compensation or in a canned cycle is in no source");
  if (machine_.mode(kPlane) != 0) return notKnown("what it does outside of G17 is in no source");
  if (machine_.rotation().on())
    return notKnown(
        "what it does in coordinates that G68 has turned is in no source; `G69` ends the rotation");
  if (machine_.uncertain() != 0) return notKnown("the place of the probe is not known");
  switch (machine_.probe()) {
  case Machine::Probe::Off:
    return notKnown("the probe was switched off before; what the macro does then is in no source");
  case Machine::Probe::NotSwitched: sayOnce("probe", "not-switched"); break;
  case Machine::Probe::On: break;
  }
  return true;
}

bool VendorRun::features() {
  if (signature_.intent == Intent::ProtectedMove) return protectedMove();
  if (!findStylus()) return false;
  switch (signature_.intent) {
  case Intent::Surface: return surface();
  case Intent::Bore:
  case Intent::Boss: return round();
  case Intent::Pocket:
  case Intent::Web: return flat();
  case Intent::InnerCorner: return innerCorner();
  case Intent::Angle: return faceAngle();
  case Intent::AngledSurface: return angledSurface();
  case Intent::AngledPocket:
  case Intent::AngledWeb: return angledFlat();
  case Intent::ThreePointBore:
  case Intent::ThreePointBoss: return threePoints();
  case Intent::OuterCorner:
  case Intent::BoltCircle:
  case Intent::StockAllowance:
  case Intent::FeatureToFeature:
  case Intent::ToolUpdate:
  case Intent::Calibration:
  case Intent::ProtectedMove:
  case Intent::ProbeOn:
  case Intent::ProbeOff: break;
  }
  return notKnown("how it measures is in no source");
}

} // namespace dotek::oracle
