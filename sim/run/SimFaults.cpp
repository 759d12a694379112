// What is wrong with a run though nothing touches: a spindle that turns while the probe measures, lengths of
// tools in offsets, a length that a called program takes off, variables that nobody has set.
#include "sim/run/SimWorld.h"
#include "support/Decimal.h"
#include "support/messages/Part.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace dotek::sim {
namespace {

constexpr std::size_t kMostFaults = 20; // that are reported
constexpr std::uint32_t kOrient = 19;   // M19

// A part is near where its offset says; lengths of tools that are no longer than that prove nothing.
constexpr double kLeastLength = 10;
bool isLength(double moved, double length) {
  return length >= kLeastLength && std::abs(std::abs(moved) - length) <= std::min(5.0, length / 20);
}

std::string signedText(double value, int decimals) {
  return (value > 0 ? "+" : "") + fixedText(value, decimals);
}

} // namespace

void SimWorld::addFault(Diagnostic diagnostic, Verdict verdict, std::string_view word, const RunPlace& place,
                        std::optional<Point3> at) {
  faults_.push_back({verdict, std::string(word), diagnostic.message.substr(0, diagnostic.message.find(';'))});
  if (!faultsTold_.insert({diagnostic.code, place.range.begin}).second || faultsTold_.size() > kMostFaults)
    return;
  if (recorder_) recorder_->faultHere(diagnostic.message, at);
  constexpr std::size_t kMostCalls = 8;
  for (std::size_t i = 0; i < place.calls.size() && i < kMostCalls; ++i)
    diagnostic.note(place.calls[place.calls.size() - 1 - i], "called here");
  session_.diagnostics().add(std::move(diagnostic));
}

void SimWorld::auxiliary(std::uint32_t code) {
  if (code == kOrient) stopSpindle();
}

void SimWorld::stopSpindle() {
  spindleStopped_ = true;
  if (machineNow_ != nullptr) spindleSeen_ = {machineNow_->spindle(), machineNow_->spindleSpeed()};
}

// A tool that cuts meets the part on purpose; of the probe it counts where it goes.
bool SimWorld::isBesideItsPath() {
  if (!options_.part || !world_ || machineNow_ == nullptr || machineNow_->mode(kComp) == 0 ||
      machineNow_->offsetsPath() || world_->cuttingTool() != nullptr || world_->isUnknownTool())
    return false;
  stop_("the probe moves under cutter compensation (`G41`, `G42`): it goes beside the programmed path, which "
        "Dotek does not follow, so what it meets is not known; write `G40` before it moves");
  return true;
}

// Some probes are switched on by turning the spindle: what counts is that it turns in a skip move.
void SimWorld::checkSpindle() {
  if (machineNow_ == nullptr) return;
  const std::uint8_t turns = machineNow_->spindle();
  const std::pair now{turns, machineNow_->spindleSpeed()};
  if (std::exchange(spindleSeen_, now) != now) spindleStopped_ = false;
  if (turns == 0 || spindleStopped_ || world_->cuttingTool() != nullptr) return;
  constexpr std::string_view kWord = "FAIL: SPINDLE ON"; // reported once a run
  if (std::any_of(faults_.begin(), faults_.end(), [&](const RunFault& one) { return one.word == kWord; }))
    return;
  const RunPlace place = place_();
  addFault(makeDiagnostic<diag::SpindleTurnsProbe>(place.range, turns == 1 ? "M3" : "M4"), Verdict::Fail,
           kWord, place);
}

void SimWorld::offsetWritten(const OffsetWrite& write) {
  log_.offsetWritten(write);
  if (machineNow_ == nullptr) return;
  checkMiss(write);
  checkWear(write);
  if (write.tool != 0 && lengthsBefore_.contains(write.tool)) lengthsWritten_[write.tool] = place_();
  const double inForce = std::abs(machineNow_->toolLength());
  const double moved = write.after - write.before;
  const bool zero = write.name.ends_with(" Z");
  // No length is in what a radius is set to.
  if (!zero && (!write.name.starts_with("tool ") || write.name.find(" radius") != std::string::npos)) return;
  // Of a system that nobody had set the part says where its zero is.
  const bool beside = zero && partZero_ && isLength(write.after - (*partZero_)[2], inForce);
  if (moved == 0 || (!isLength(moved, inForce) && !beside)) return;
  const RunPlace place = place_();
  addFault(makeDiagnostic<diag::OffsetHoldsLength>(
               place.range, write.name, fixedText(write.before, decimals_), fixedText(write.after, decimals_),
               signedText(isLength(moved, inForce) ? moved : write.after - (*partZero_)[2], decimals_),
               isLength(moved, inForce) ? "its last value" : "where the part is meant to be",
               fixedText(inForce, decimals_)),
           Verdict::Fail, "FAIL: TOOL LENGTH IN AN OFFSET", place);
}

// The caller goes on in coordinates that are those of the spindle now.
void SimWorld::checkLength(const MachineMotion& motion) {
  if (!lostLength_ || machineNow_ == nullptr) return;
  if (machineNow_->toolLength() != 0) {
    lostLength_.reset();
    return;
  }
  if (motion.from[2] == motion.to[2] || machineNow_->goesToMachine()) return;
  const LostLength lost = *std::exchange(lostLength_, std::nullopt);
  const RunPlace place = place_();
  const double z = machineNow_->position()[2];
  addFault(makeDiagnostic<diag::LengthTakenOff>(place.range, fmt::format("O{:04}", lost.program),
                                                fixedText(lost.length, decimals_), fixedText(z, decimals_),
                                                fixedText(z - lost.length, decimals_)),
           Verdict::Fail, "FAIL: TOOL LENGTH OFF", place);
}

void SimWorld::noteEmptyOffset(Diagnostic& finding) const {
  const CuttingTool* const tool = world_ ? world_->cuttingTool() : nullptr;
  if (tool == nullptr || machineNow_ == nullptr || tool->length == 0 ||
      tool->number >= machineNow_->toolTable().size() || machineNow_->toolLengthOf(tool->number) != 0)
    return;
  const std::string length = numberText(tool->length);
  finding.note(
      {},
      fmt::format(
          "tool offset {0} (H{0}) is 0, and tool {0} is {1} mm long; a program that reads the offset takes "
          "the tool for that long; `tools = [{{ number = {0}, length = {1} }}]` of [setup] sets "
          "it as an operator does",
          tool->number, length));
}

// A program reads where it is, perhaps by a variable that holds the length.
void SimWorld::noteHeight() {
  constexpr std::size_t kMostHeights = 64;
  if (machineNow_ == nullptr || std::abs(machineNow_->toolLength()) < kLeastLength) return;
  const double z = machineNow_->position()[2];
  if (std::isfinite(z) && heightsRead_.size() < kMostHeights) heightsRead_.insert(std::llround(z * 1000));
}

// Back to a height that the program has read, and higher by the length of the tool: it was not taken off, or
// its wear was taken for it.
void SimWorld::checkHeight(const MachineMotion& motion) {
  if (heightsRead_.empty() || machineNow_ == nullptr || motion.kind == MotionKind::Skip ||
      motion.from[2] == motion.to[2] || machineNow_->goesToMachine() || !rangeNow_)
    return;
  const double length = machineNow_->toolLength(), z = machineNow_->position()[2];
  if (std::abs(length) < kLeastLength || !std::isfinite(z)) return;
  std::set<double> takenOff{0.0}; // instead of the length: nothing, or the wear of an offset that is in force
  for (const Machine::ToolOffset& entry : machineNow_->toolTable())
    if (std::abs(entry.wear + entry.geometry - std::abs(length)) < 1e-6 && entry.geometry != 0)
      takenOff.insert(entry.wear);
  for (const double taken : takenOff) {
    // Under G20 a word is rounded to a ten-thousandth of an inch.
    constexpr long long kRounding = 2;
    const long long meant = std::llround((z - length + taken) * 1000);
    const auto found = heightsRead_.lower_bound(meant - kRounding);
    if (found == heightsRead_.end() || *found > meant + kRounding) continue;
    const long long read = *found;
    // A height that is written out is where the programmer wants it.
    const std::string text = session_.sources().textUtf8(rangeNow_());
    const std::size_t word = text.find_first_of("Zz");
    const std::size_t value = word == std::string::npos ? word : text.find_first_not_of(" +-", word + 1);
    if (value == std::string::npos || (text[value] != '#' && text[value] != '[')) return;
    const stdlib::SystemVariables& v = machineNow_->control().variables;
    const std::string tables =
        v.toolWear && v.toolGeometry
            ? fmt::format(" (#[{}+n] is the wear of a tool on this control, its length is #[{}+n]+#[{}+n])",
                          *v.toolWear, *v.toolGeometry, *v.toolWear)
            : "";
    const RunPlace place = place_();
    addFault(makeDiagnostic<diag::MoveHoldsLength>(
                 place.range, fixedText(z, decimals_), fixedText(length, decimals_),
                 fixedText(static_cast<double>(read) / 1000, decimals_), tables),
             Verdict::Fail, "FAIL: TOOL LENGTH IN A MOVE", place);
    return;
  }
}

// The run is over: no call is open, and no block holds two of the same number.
void SimWorld::unsetRead(std::uint32_t number, SourceRange range) {
  const SourceFile& file = session_.sources().file(range.file);
  faults_.push_back({Verdict::Doubt, "PASS, WITH VALUES MISSING",
                     fmt::format("nobody has set #{}, and it counts as 0 ({}:{})", number, file.name(),
                                 file.place(range.begin).line)});
  session_.diagnostics().report<diag::VariableNotSet>(range, number, number);
}

} // namespace dotek::sim
