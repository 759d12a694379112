// Runs a compiled program from a known state of the machine in a world, and records what it does.
#pragma once

#include "sim/machine/Bytecode.h"
#include "sim/machine/MacroMeaning.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "support/Limits.h"
#include "verify/Recorder.h"

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace dotek::verify {

// Of the stylus's lowest point below the spindle's gauge line, where no machine file says it (mm).
inline constexpr double kToolLength = 150;

// What each number of the tool table is longer than the one before, so that a mixed-up one shows (mm).
inline constexpr double kToolStep = 0.01;

// Zeros of G54 to G59 in coordinates of the machine: all different, so that a mixed-up system shows.
std::array<sim::Point3, 6> standZeros();

// What a stand gives a variable of the macros of a set, for a ball of this radius; nothing: no value.
std::optional<double> presetOf(const stdlib::MacroSet& set, std::uint32_t number, double ballRadius);

// What holds before the program's first block, beside what is in force at the start.
struct Entry {
  sim::Point3 start; // of the stylus's lowest point, system `system`
  std::uint32_t system = 54;
  // Its length is the probe's, and it is in force; 1 where the control has no such number.
  std::uint32_t toolOffset = 1;
  std::optional<std::uint32_t> otherOffset = {}; // in force in its place; 0: none
  // The length stays in force over G28 and G53 in Z, as a parameter has it on most controls; else nobody
  // knows.
  bool keepsLength = false;
  std::array<sim::Point3, 6> zeros = standZeros();
  double feed = 800;        // mm/min
  std::uint8_t spindle = 0; // 1 clockwise, 2 counterclockwise
  sim::Machine::Coolant coolant = sim::Machine::Coolant::NotSwitched;
  // What the caller has put in force besides: blocks of NC, then codes (times ten) by their groups that only
  // a read of the group sees.
  std::string blocks;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> modal;
  bool probeOn = false;
  double contactShare = 1;                                 // of a rehearsal: Recorder::rehearse
  std::uint64_t noiseSeed = 0;                             // of a probe whose signal is noisy
  std::vector<std::pair<std::uint32_t, double>> variables; // set before: locals, commons
  // Surfaces that the path of the source shows, coordinates of the machine; for Measure::drawn.
  std::vector<Touch> drawn = {};
};

class Stand {
public:
  // All outlive the stand. `sets`: macros whose calls count as one thing; `texts`: of those, the ones that
  // run by their text. `meaning`: of the others.
  Stand(const stdlib::Control& control, std::vector<const stdlib::MacroSet*> sets, const Limits& limits,
        const sim::Dialect& dialect = {});

  enum class Way : std::uint8_t { Run, KeepMoves, Rehearse, MovePath }; // Recorder.h
  // The first program of `code`, in `world`, which is restarted; rehearsed it meets nothing of it.
  Record run(const sim::Bytecode& code, sim::World& world, const Entry& entry,
             const std::set<std::uint32_t>& stores, sim::MacroMeaning* meaning, Way way = Way::Run,
             const Interference& interference = {}) const;
  // Of the code that is to run: Recorder::watchOnly.
  void watchOnly(sim::BlockSet blocks) { watching_ = std::move(blocks); }
  // Subprograms that are not at hand do nothing: what is compared is where and with what they are called.
  void passOverAbsent() { passesOverAbsent_ = true; }
  // Common variables that Record::strays reports.
  void watchStores(std::set<std::uint32_t> numbers) { watchedStores_ = std::move(numbers); }
  // Takes the trace of the runs to come (sim/machine/Trace.h), without the state before the program. nullptr:
  // nobody.
  void setTrace(sim::Trace* trace) { trace_ = trace; }

private:
  bool prepare(sim::Machine& machine, const Entry& entry, double ballRadius, double length) const;

  std::vector<const stdlib::MacroSet*> sets_;
  const Limits& limits_;
  sim::Trace* trace_ = nullptr;
  sim::BlockSet watching_;
  bool passesOverAbsent_ = false;
  std::set<std::uint32_t> watchedStores_;
  const sim::Machine fresh_;
  // Of the last run: what is assigned for the next keeps its memory. So a stand is used by one thread.
  mutable std::optional<sim::Machine> machine_;
};

} // namespace dotek::verify
