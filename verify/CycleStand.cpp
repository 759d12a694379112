#include "verify/CycleStand.h"

#include "ir/CycleNames.h"
#include "sim/cycle/CycleMachine.h"

#include <utility>

namespace dotek::verify {

namespace {

sim::Machine machineAt(const Entry& entry, double length) {
  sim::Machine machine(sim::cycleControl());
  for (std::uint32_t system = 0; system < entry.zeros.size(); ++system) {
    const sim::Point3& zero = entry.zeros[system];
    machine.setZero(system, {zero.x, zero.y, zero.z});
  }
  const auto own = entry.toolOffset;
  for (std::uint32_t tool = 1; tool <= 999; ++tool)
    machine.setToolLength(tool, length + kToolStep * (static_cast<double>(tool) - static_cast<double>(own)));
  machine.putTool(own);
  machine.startSpindle(entry.spindle);
  machine.startCoolant(entry.coolant);
  machine.setFeed(entry.feed);
  machine.selectSystem({entry.system - 54, false});
  machine.holdTool(length);
  const sim::Point3 at = entry.start + entry.zeros[entry.system - 54];
  machine.startAt({at.x, at.y, at.z + length});
  for (const auto& [number, value] : entry.variables)
    machine.preset(number, value);
  return machine;
}

// Touches after which the cycle goes on where nothing is found.
std::set<std::pair<FileId, std::size_t>> mayMissIn(const ir::Cycle& cycle) {
  std::set<std::pair<FileId, std::size_t>> out;
  for (const ir::CycleStatement& statement : cycle.body) {
    const auto* const call = std::get_if<ir::CallCycle>(&statement.node);
    if (call == nullptr || (call->cycle != ir::kSurface && call->cycle != ir::kSurfaceAlong)) continue;
    const SourceRange range = statement.origin.range();
    for (const ir::CycleArgument& argument : call->arguments)
      if (argument.parameter == "miss") out.emplace(range.file, range.begin);
  }
  return out;
}

} // namespace

Record CycleStand::run(const ir::Cycle& cycle, sim::CycleInputs inputs, sim::World& world, const Entry& entry,
                       const std::set<std::uint32_t>& stores, bool keepMoves, bool movePath,
                       const Interference& interference, sim::CycleWay* way) const {
  inputs.take(world.probe());
  const double length = inputs.tipLength;
  sim::Machine machine = machineAt(entry, length);
  world.restart(entry.noiseSeed);
  world.setOn(entry.probeOn);
  sim::CycleRun run(machine, cycle, std::move(inputs), limits_);
  if (way != nullptr) run.follow(*way);
  Recorder recorder(machine, world, {}, length);
  recorder.assumeProbe(entry.probeOn ? Switch::On : Switch::Off);
  if (movePath) recorder.datumsMovePath();
  recorder.interfere(interference);
  recorder.begin([&run] { return run.place(); }, keepMoves);
  machine.setSkipSignal(&recorder);
  machine.setWatcher(&recorder);
  run.run();
  machine.setWatcher(nullptr);
  Record record = recorder.finish(stores);
  const auto mayMiss = mayMissIn(cycle);
  for (Measure& measure : record.measures)
    if (mayMiss.contains({measure.range.file, measure.range.begin}))
      measure.options[stdlib::ArgumentRole::FlagOnly] = 1;
  if (const auto kind = run.alarmKind()) record.alarmKind = stdlib::macroAlarmName(*kind);
  return record;
}

CycleStand::Rehearsal CycleStand::rehearse(const ir::Cycle& cycle, sim::CycleInputs inputs,
                                           const sim::Probe& probe, const Entry& entry) const {
  inputs.take(probe);
  sim::Machine machine = machineAt(entry, inputs.tipLength);
  sim::CycleRun run(machine, cycle, std::move(inputs), limits_, true);
  run.run();
  Rehearsal out;
  const auto mayMiss = mayMissIn(cycle);
  for (const sim::ExpectedSurface& one : run.expected()) {
    out.surfaces.push_back({one.point, one.direction, one.distance});
    out.mayMiss.push_back(mayMiss.contains({one.range.file, one.range.begin}));
  }
  const sim::RunEnd& end = machine.end();
  if (end.ending == sim::Ending::TextEnd) return out;
  out.ending = end.ending == sim::Ending::Alarm ? Ending::Alarm : Ending::Inconclusive;
  out.text = end.text;
  out.at = run.place();
  return out;
}

} // namespace dotek::verify
