#include "verify/Stand.h"

#include "frontend/nc/Scan.h"
#include "support/LineChunks.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::verify {

namespace {

// By which the axes brake after the signal, mm: more than a rounding, less than any path back.
constexpr double kStopsBeyond = 0.02;
constexpr double kMacroFeed = 1000; // of protected moves, where a set keeps it in a variable
constexpr std::uint32_t kFirstSystemVariable = 1000;
constexpr int kLetterT = 20; // of the words in force: A is the first

} // namespace

std::array<sim::Point3, 6> standZeros() {
  std::array<sim::Point3, 6> out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double n = static_cast<double>(i);
    out[i] = {100 + 17 * n, -200 - 23 * n, -300 + 31 * n};
  }
  return out;
}

namespace {

// What has to be set before the macros of a set are called.
template <class Give> void eachPreset(const stdlib::MacroSet& set, double ballRadius, const Give& give) {
  const stdlib::ProbingFacts& facts = set.probing;
  if (facts.feedVariable) give(*facts.feedVariable, kMacroFeed);
  if (set.callerValues.empty()) return;
  for (const auto& radius : {facts.radiusX, facts.radiusY})
    if (radius) give(*radius, ballRadius);
  for (const auto& [number, value] : set.callerValues)
    give(number, value);
}

} // namespace

std::optional<double> presetOf(const stdlib::MacroSet& set, std::uint32_t number, double ballRadius) {
  std::optional<double> out;
  eachPreset(set, ballRadius, [&](std::uint32_t one, double value) {
    if (one == number) out = value;
  });
  return out;
}

Stand::Stand(const stdlib::Control& control, std::vector<const stdlib::MacroSet*> sets, const Limits& limits,
             const sim::Dialect& dialect)
    : sets_(std::move(sets)), limits_(limits), fresh_(control, dialect) {}

bool Stand::prepare(sim::Machine& machine, const Entry& entry, double ballRadius, double length) const {
  machine.stopBeyond(kStopsBeyond);
  machine.startSpindle(entry.spindle);
  machine.startCoolant(entry.coolant);
  if (machine.dialect().holdsTool) {
    // One active system, and no code that would put a tool or another system in force.
    const sim::Point3& zero = entry.zeros[entry.system - 54];
    const sim::Point3 at = entry.start + zero;
    machine.holdTool(length);
    machine.setZero(0, {zero.x, zero.y, zero.z});
    machine.startAt({at.x, at.y, at.z + length});
    return true;
  }
  for (std::uint32_t system = 0; system < entry.zeros.size(); ++system) {
    const sim::Point3& zero = entry.zeros[system];
    machine.setZero(system, {zero.x, zero.y, zero.z});
  }
  const auto last = static_cast<std::uint32_t>(std::max(1, machine.control().variables.toolCount));
  const std::uint32_t own = entry.toolOffset >= 1 && entry.toolOffset <= last ? entry.toolOffset : 1;
  for (std::uint32_t tool = 1; tool <= last; ++tool)
    machine.setToolLength(tool, length + kToolStep * (static_cast<double>(tool) - static_cast<double>(own)));
  for (const stdlib::MacroSet* set : sets_)
    eachPreset(*set, ballRadius, [&](std::uint32_t number, double value) { machine.preset(number, value); });
  std::string text = fmt::format("G21G17G40G49G80G90G94G{}\nG0X{:.6f}Y{:.6f}\nG43H{}Z{:.6f}\n", entry.system,
                                 entry.start.x, entry.start.y, own, entry.start.z);
  if (entry.otherOffset) {
    // The same place, as it counts with that length.
    const std::uint32_t other = *entry.otherOffset;
    const double z = entry.start.z + length - (other == 0 ? 0 : machine.toolLengthOf(other));
    text += other == 0 ? fmt::format("G49Z{:.6f}\n", z) : fmt::format("G43H{}Z{:.6f}\n", other, z);
  }
  text += fmt::format("F{:.1f}\n{}", entry.feed, entry.blocks);
  LineChunks chunks(text);
  frontend::nc::Scanner scanner(chunks);
  ir::NcWords words;
  while (scanner.next(words) == frontend::nc::Scanner::Result::Block)
    if (!machine.execute(words)) return false;
  // One of the two ways of a control does: both sides run under it, and a length that one of them lacks, or
  // puts in force later, moves its path.
  if (entry.otherOffset) machine.keepPlaceOnToolLength();
  if (entry.keepsLength) machine.keepToolLength();
  for (const auto& [group, tenths] : entry.modal)
    machine.presetModal(group, tenths);
  for (const auto& [number, value] : entry.variables) {
    const auto& inForce = machine.control().variables.modalWords;
    if (inForce && number == static_cast<std::uint32_t>(*inForce + kLetterT))
      machine.putTool(static_cast<std::uint32_t>(value));
    else if (!machine.preset(number, value) && number >= kFirstSystemVariable)
      return false;
  }
  return machine.running();
}

Record Stand::run(const sim::Bytecode& code, sim::World& world, const Entry& entry,
                  const std::set<std::uint32_t>& stores, sim::MacroMeaning* meaning, Way way,
                  const Interference& interference) const {
  if (machine_)
    *machine_ = fresh_;
  else
    machine_.emplace(fresh_);
  sim::Machine& machine = *machine_;
  const double length = world.probe().centreLength() + world.probe().ballRadius();
  if (!prepare(machine, entry, world.probe().ballRadius(), length)) {
    Record record;
    record.ending = Ending::Inconclusive;
    record.text = "the state before the program cannot be reached: " + machine.end().text;
    return record;
  }
  world.restart(entry.noiseSeed);
  world.setOn(entry.probeOn);
  sim::Run run(machine, code, limits_, meaning);
  run.expectMotion();
  if (world.tie() > 0) {
    std::set<std::uint64_t> macros;
    for (const stdlib::MacroSet* set : sets_)
      for (const stdlib::MacroSignature& one : set->signatures)
        macros.insert(one.program);
    run.setTie(world.tie(), std::move(macros));
  }
  if (passesOverAbsent_) run.passOverAbsent();
  if (!stores.empty()) run.watchWrites(stores);
  Recorder recorder(machine, world, sets_, length);
  recorder.assumeProbe(entry.probeOn ? Switch::On : Switch::Off);
  if (way == Way::Rehearse) recorder.rehearse(entry.contactShare);
  if (way == Way::MovePath) recorder.datumsMovePath();
  if (!entry.drawn.empty()) recorder.expectDrawn(entry.drawn);
  recorder.interfere(interference);
  recorder.watchOnly(&watching_);
  recorder.watchStores(watchedStores_);
  recorder.begin(run, way == Way::KeepMoves);
  machine.setSkipSignal(&recorder);
  machine.setWatcher(&recorder);
  machine.setTrace(trace_);
  run.run();
  machine.setWatcher(nullptr);
  machine.setSkipSignal(nullptr);
  machine.setTrace(nullptr);
  Record record = recorder.finish(stores);
  record.printed = run.output();
  record.portOpen = run.portIsOpen();
  return record;
}

} // namespace dotek::verify
