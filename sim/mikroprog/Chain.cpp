#include "sim/mikroprog/Chain.h"

#include "sim/machine/Machine.h"
#include "sim/machine/Value.h"
#include "sim/mikroprog/Dialect.h"

#include <bit>
#include <fmt/format.h>

namespace dotek::sim::mikroprog {

namespace {

bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (isNull(a) && isNull(b));
}

} // namespace

// In force is what the control has at the start of a program, so whether it survives makes no difference.
bool Chain::isAsAtStart(Machine& machine, double* cells, bool leaving) const {
  const auto kept = [&](std::uint32_t what) {
    const double value = cells[machine.layout().cellOf(variableOf(what))];
    return !isNull(value) && value != 0;
  };
  const auto no = [&](std::string_view what, std::string_view instead) {
    return machine.inconclusive(
        leaving ? fmt::format(
                      "{} at the end of a program that G28 runs, and what of its state lasts is not stated "
                      "(Q25); write {} before its M30",
                      what, instead)
                : fmt::format(
                      "{} at this G28, and what of the state the program finds that it runs is not stated "
                      "(Q25); write {} before it",
                      what, instead));
  };
  const std::uint8_t plane = control_.hasAxis('Y') ? 0 : 1;
  if (machine.mode(kDistance) != 0) return no("G91 is in force", "G90");
  if (kept(kRadius)) return no("G24 is in force", "G90");
  if (machine.mode(kPlane) != plane) return no("another plane is in force", plane == 0 ? "G17" : "G18");
  if (machine.mode(kFeedMode) != 0) return no("G95 is in force", "G94");
  if (machine.mode(kComp) != 0) return no("G41 or G42 is in force", "G40");
  if (kept(kShift)) return no("a shift is in force", "G50");
  if (kept(kSurface)) return no("G96 is in force", "an S");
  if (machine.positionShift() != Position{}) return no("G92 is in force", "G98");
  if (leaving && machine.spindle() != 0) return no("the spindle turns", "M5");
  if (leaving && machine.coolant() == Machine::Coolant::Flood) return no("the coolant is on", "M9");
  return true;
}

bool Chain::enter(Machine& machine, double* cells) {
  if (!assumed_ && !isAsAtStart(machine, cells, false)) return false;
  Open open{{}, calls_};
  calls_ = 0;
  if (!assumed_) {
    for (std::uint32_t parameter = 0; parameter <= kLastParameter; ++parameter) {
      double& cell = cells[machine.layout().cellOf(variableOf(parameter))];
      open.parameters.push_back(cell);
      cell = kNull;
    }
    machine.forgetMotion(std::nullopt);
  }
  open_.push_back(std::move(open));
  return true;
}

bool Chain::leave(Machine& machine, double* cells) {
  if (open_.empty()) return true; // the profile's own end of a program comes first
  if (calls_ != 0)
    return machine.inconclusive(
        "whether M30 in a subprogram ends the program that G28 runs is not stated (Q25)");
  if (!assumed_ && !isAsAtStart(machine, cells, true)) return false;
  for (std::uint32_t parameter = 0; parameter < open_.back().parameters.size(); ++parameter) {
    double& cell = cells[machine.layout().cellOf(variableOf(parameter))];
    const double before = open_.back().parameters[parameter];
    // One that the other program has set to another value has this one, or the one before: nobody knows.
    if (isNull(cell) || same(cell, before))
      cell = before;
    else
      cell = kNull;
  }
  if (!assumed_) machine.forgetMotion(std::nullopt);
  calls_ = open_.back().calls;
  open_.pop_back();
  return true;
}

} // namespace dotek::sim::mikroprog
