// Touches that come to something else than the program takes them for: an edge instead of a face, and a
// correction of a tool that goes the wrong way.
#include "sim/run/SimWorld.h"
#include "support/Decimal.h"
#include "support/messages/Part.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {
namespace {

// Whether the surface ends at this point of it, so that a ball which comes along the normal meets an edge:
// from a place beside the normal the point is still the nearest.
bool isEdge(const Part& part, const Point3& point, const Point3& normal) {
  constexpr double kAway = 0.05;   // mm; what is rounded by less counts as an edge
  constexpr double kFarther = 1.2; // times as far as from a face: the surface turns by 34 degrees or more
  const Point3 other = std::abs(normal.z) < 0.9 ? Point3{0, 0, 1} : Point3{1, 0, 0};
  Point3 across = other - normal * normal.dot(other);
  across = across * (1 / across.length());
  const Point3 along{normal.y * across.z - normal.z * across.y, normal.z * across.x - normal.x * across.z,
                     normal.x * across.y - normal.y * across.x};
  for (const Point3& side : {across, across * -1.0, along, along * -1.0})
    if (part.distance(point + (normal + side) * kAway) > kFarther * kAway) return true;
  return false;
}

} // namespace

// What is measured there is nearer to the middle of the ball than the face that the move looks for.
void SimWorld::checkEdge(const ProbeEvent& event, const RunPlace& place) {
  if (event.kind != MotionKind::Skip || isProtected() || !world_ || world_->part().isEmpty() ||
      world_->cuttingTool() != nullptr)
    return;
  const double reach = (event.centre - event.point).length();
  if (!isEdge(world_->part(), event.point, event.normal)) return;
  const Point3 way = event.point - event.centre;
  Point3 ahead = searchWay_;
  if (ahead.length() == 0) return;
  ahead = ahead * (1 / ahead.length());
  // The signal comes where a ball of the effective radius would touch.
  const double across = std::sqrt(std::max(0.0, reach * reach - way.dot(ahead) * way.dot(ahead)));
  const double radius = std::min(reach, world_->probe().effectiveRadius);
  const double off = radius - std::sqrt(std::max(0.0, radius * radius - across * across));
  constexpr double kLeastOff = 0.001; // mm; at the edge itself it is right
  if (off < kLeastOff) return;
  // One depth is one cause: further places are notes of the first.
  constexpr std::size_t kMostNotes = 10;
  for (Diagnostic& told : session_.diagnostics().all()) {
    if (told.code != diag::EdgeTouched::code || told.range == place.range) continue;
    const bool known = std::any_of(told.notes.begin(), told.notes.end(),
                                   [&](const auto& note) { return note.range == place.range; });
    if (!known && told.notes.size() < kMostNotes)
      told.note(place.range, fmt::format("so does this one, by {} mm", fixedText(off, decimals_)));
    return;
  }
  addFault(makeDiagnostic<diag::EdgeTouched>(place.range, fixedText(off, decimals_)), Verdict::Doubt,
           "PASS, AN EDGE TOUCHED", place, event.centre);
}

// A face that lies too high was cut by a tool that is longer than its offset says. The expected height is in
// a variable, or 0.
void SimWorld::checkWear(const OffsetWrite& write) {
  const double moved = write.after - write.before;
  constexpr double kLeast = 1e-4, kSame = 1e-6;
  if (write.tool == 0 || !heightTouched_ || machineNow_ == nullptr || std::abs(moved) < kLeast) return;
  // The probe measures its own length so, and G44 counts lengths the other way.
  if (machineNow_->tool() == write.tool || (machine_ && machine_->devices.probeTool == write.tool) ||
      machineNow_->toolLength() < 0)
    return;
  const double expected = *heightTouched_ - moved;
  const stdlib::Control& control = machineNow_->control();
  const auto holds = [&](std::uint32_t number) {
    return std::abs(machineNow_->common(number) - expected) < kSame;
  };
  bool found = std::abs(expected) < kSame;
  for (std::uint32_t number = 1; !found && number <= control.locals; ++number)
    found = holds(number);
  for (const stdlib::VariableRange& range : control.common)
    for (std::uint32_t number = range.first; !found && number <= range.last; ++number)
      found = holds(number);
  if (!found) return;
  addFault(makeDiagnostic<diag::WearWrongWay>(place_().range, write.name, fixedText(write.before, decimals_),
                                              fixedText(write.after, decimals_),
                                              fixedText(*heightTouched_, decimals_),
                                              fixedText(expected, decimals_), moved > 0 ? "high" : "low"),
           Verdict::Doubt, "PASS, WEAR THE WRONG WAY", place_());
}

// The offset was the tool's length and is far from it now, or is the length with the other sign. What an
// offset counts from is the shop's: others than these may be meant.
void SimWorld::tellToolLengths() {
  constexpr double kSame = 5; // mm
  if (machineNow_ == nullptr || !end_) return;
  const Ending ending = end_().ending;
  if (ending != Ending::ProgramEnd && ending != Ending::TextEnd) return;
  for (const auto& [number, place] : lengthsWritten_) {
    const CuttingTool* const tool = machine_->devices.find(number);
    if (tool == nullptr || tool->length <= kSame) continue;
    const double before = lengthsBefore_.at(number), after = machineNow_->toolLengthOf(number);
    const bool turned = std::abs(after + tool->length) <= kSame;
    const bool lost = std::abs(before - tool->length) <= kSame && std::abs(after - tool->length) > kSame;
    if (!turned && !lost) continue;
    const double off = after - tool->length;
    addFault(makeDiagnostic<diag::ToolOffsetNotLength>(place.range, number, fixedText(after, decimals_),
                                                       fixedText(tool->length, decimals_),
                                                       (off > 0 ? "+" : "") + fixedText(off, decimals_)),
             Verdict::Fail, "FAIL: TOOL OFFSET WRONG", place);
  }
}

std::string SimWorld::startText() const {
  if (setup_.call.empty() || machineNow_ == nullptr || contactCount_ > 0) return "";
  const bool isSaid = setup_.at || (machine_ && machine_->start != std::array<double, 3>{});
  const std::string name = fmt::format("G{}", 54 + startSystem_);
  const Position zero = machineNow_->zeroOf(startSystem_);
  std::string out;
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  if (!isSaid) {
    Position start = start_;
    if (setup_.tool) start[2] -= machineNow_->toolLengthOf(*setup_.tool);
    add(fmt::format("`--at X,Y,Z` where the tool's end is before the call (it was at {} X{} Y{} Z{})", name,
                    fixedText(start[0] - zero[0], decimals_), fixedText(start[1] - zero[1], decimals_),
                    fixedText(start[2] - zero[2], decimals_)));
  }
  if (zero == Position{} && (!partZero_ || *partZero_ != std::array<double, 3>{}))
    add(fmt::format("`--work-offset {}={}` where its zero is", name, partZero_ ? "part" : "X,Y,Z"));
  if (!setup_.tool)
    add(machine_ && machine_->probe.length > 0 ? "`--tool N` which tool is in the spindle"
                                               : "`--tool N --length L` which tool is in the spindle");
  return out.empty() ? "" : "what the macro begins with is not said: " + out;
}

void SimWorld::noteStart(Diagnostic& finding) {
  if (startTold_) return;
  if (const std::string text = startText(); !text.empty()) {
    finding.note({}, text);
    startTold_ = true;
  }
}

std::string SimWorld::startAdvice() const {
  if (startTold_ || machineNow_ == nullptr) return "";
  const RunEnd& end = machineNow_->end();
  const auto met = [&](Outcome outcome) { return outcomes_[static_cast<std::size_t>(outcome)] > 0; };
  const bool missed = met(Outcome::Miss) || met(Outcome::SetterMiss);
  const bool here = (end.ending == Ending::Alarm && missed) ||
                    (end.ending == Ending::Inconclusive && end.text.starts_with("no part is given"));
  return here ? startText() : "";
}

void SimWorld::noteZeroLeftOut(Diagnostic& finding) const {
  if (!zeroLeftOut_) return;
  finding.note({},
               fmt::format("`{}` puts G{} where the part is, and no part is given: its zero is that of the "
                           "machine; `--part PART.toml` or `--work-offset G{}=X,Y,Z` says where it is",
                           options_.machine.value_or("[setup]"), 54 + *zeroLeftOut_, 54 + *zeroLeftOut_));
}

} // namespace dotek::sim
