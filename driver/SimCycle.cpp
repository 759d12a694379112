// A cycle runs by its meaning, on the part of --part or on one that its own touches make.
#include "driver/SimCycle.h"

#include "driver/Command.h"
#include "project/CycleFiles.h"
#include "project/CycleLowering.h"
#include "project/CycleValues.h"
#include "project/Hosts.h"
#include "project/Job.h"
#include "sim/cycle/CycleMachine.h"
#include "sim/cycle/CycleRun.h"
#include "sim/machine/Trace.h"
#include "sim/run/CycleReport.h"
#include "sim/run/SimWorld.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Sim.h"
#include "verify/DrawnPath.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace dotek::driver {
namespace {

constexpr double kBall = 6, kLength = 150; // of the stylus where nothing says it, mm
constexpr std::string_view kNoPart = "none";

// With a stem and a body like those that `verify` takes.
sim::Probe usualProbe(double ball) {
  sim::Probe out;
  out.ballDiameter = ball;
  out.effectiveRadius = ball / 2;
  out.length = kLength;
  out.stemDiameter = 0.6 * ball;
  out.stemLength = 60;
  out.bodyDiameter = 40;
  out.bodyLength = 50;
  return out;
}

class CycleCommand {
public:
  CycleCommand(const SimOptions& options, Session& session)
      : options_(options), session_(session), files_(session) {}

  Outcome run() {
    refuseFlags();
    if (diagnostics().hasErrors() || !lower() || !takeValues()) return outcomeOf(session_, "");
    const auto radius = hosts_.find("tool_radius");
    const bool noPart = options_.part == kNoPart && !std::filesystem::exists(std::string(kNoPart));
    if (noPart) options_.part.reset();
    if (options_.part && !saysStart()) {
      diagnostics().report<diag::MissingOption>({}, "sim", "--at X,Y,Z",
                                                "where the probe is when the cycle begins, in G54");
      return outcomeOf(session_, "");
    }
    world_ = sim::SimWorld::loadForCycle(
        options_, usualProbe(radius == hosts_.end() ? kBall : 2 * radius->second), session_);
    if (!world_) return outcomeOf(session_, "");
    sim::Machine machine(sim::cycleControl());
    if (!world_->prepare(machine) || !world_->startsWithinTravel(machine)) return outcomeOf(session_, "");
    machine.holdTool(machine.toolLengthOf(*world_->setup().tool));
    machine.startAt(world_->startOf(machine));
    takeProbe();
    machine.setFeed(cycleInputs_.approachFeed);
    if (!options_.part && !noPart && !makePart(machine)) return outcomeOf(session_, "");
    return runIn(machine);
  }

private:
  Diagnostics& diagnostics() { return session_.diagnostics(); }

  void refuseFlags() {
    const auto none = [&](bool given, std::string_view flag) {
      if (given) diagnostics().report<diag::OptionOfPrograms>({}, flag);
    };
    none(!options_.variables.empty(), "--var");
    none(!options_.shown.empty(), "--show");
    none(!options_.programs.empty(), "--programs");
    none(options_.probeMacros.has_value(), "--probe-macros");
    none(!options_.control.empty(), "--control");
    none(!options_.setup.call.empty(), "--call");
  }

  // --at, or [setup] of the machine's or the job's file.
  bool saysStart() const {
    if (options_.setup.at || options_.machine) return true;
    return job_ && job_->setup.at;
  }

  bool lower() {
    if (auto lowered = project::lowerCycleFile(options_.program, session_))
      cycle_ = std::move(lowered->cycle);
    hosts_ = parseHosts(session_.options().host, diagnostics());
    if (session_.options().job) job_ = loadJob(*session_.options().job, session_);
    if (job_) hosts_.insert(job_->hosts.begin(), job_->hosts.end());
    if (cycle_) sets_ = cycleValues(*files_.linked(options_.program), session_.options().set, diagnostics());
    return cycle_ && !diagnostics().hasErrors();
  }

  // What the caller gives; nothing is made up for a parameter.
  bool takeValues() {
    const ir::Cycle& cycle = *cycle_;
    cycleInputs_.values.resize(cycle.variables.size());
    for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
      const ir::Variable& variable = cycle.variable(id);
      const auto& given = variable.role == ir::Role::Host ? hosts_ : sets_;
      const auto fixed = variable.role == ir::Role::Local ? given.end() : given.find(variable.name);
      if (fixed != given.end())
        cycleInputs_.values[id] = ir::Scalar::of(fixed->second);
      else if (variable.role == ir::Role::Parameter && variable.defaultValue)
        cycleInputs_.values[id] = ir::Scalar::of(*variable.defaultValue);
      else if (variable.role == ir::Role::Parameter && variable.optional)
        cycleInputs_.values[id] = ir::Scalar::null();
      else if (variable.role == ir::Role::Parameter)
        diagnostics().report<diag::ParameterMissing>(
            variable.range, variable.name,
            variable.meaning.empty() ? "" : fmt::format(" ({})", variable.meaning));
    }
    return !diagnostics().hasErrors();
  }

  // And says what the run takes that nothing has said.
  void takeProbe() {
    cycleInputs_.take(world_->probe());
    const auto host = [&](const char* name) {
      const auto found = hosts_.find(name);
      return found == hosts_.end() ? std::nullopt : std::optional(found->second);
    };
    if (const auto over = host("overtravel")) cycleInputs_.overtravel = *over;
    cycleInputs_.retract = host("retract");
    const auto say = [&](std::string_view what, const std::string& taken) {
      diagnostics().report<diag::CycleRunTakes>({}, what, taken);
    };
    if (!world_->hasMachineFile() && !world_->setup().ballDiameter && !hosts_.contains("tool_radius"))
      say("what the stylus is like (`--machine`, `--diameter`, `--host tool_radius=MM`)",
          fmt::format("a ball of {} mm", numberText(kBall)));
    const auto& body = cycle_->body;
    const bool searches = std::any_of(body.begin(), body.end(), [](const ir::CycleStatement& statement) {
      if (std::holds_alternative<ir::Measure>(statement.node)) return true;
      const auto* call = std::get_if<ir::CallCycle>(&statement.node);
      return call != nullptr && call->moves &&
             std::none_of(call->arguments.begin(), call->arguments.end(),
                          [](const ir::CycleArgument& one) { return one.parameter == "overtravel"; });
    });
    if (searches && !hosts_.contains("overtravel"))
      say("how far a touch searches beyond the expected contact (`--host overtravel=MM`)",
          numberText(cycleInputs_.overtravel) + " mm");
    for (const ir::Variable& variable : cycle_->variables) {
      if (variable.role != ir::Role::Host || hosts_.contains(variable.name)) continue;
      if (variable.name == "approach_feed") say("`approach_feed`", "500 mm/min");
      if (variable.name == "measuring_feed") say("`measuring_feed`", "50 mm/min");
    }
  }

  // false: reported.
  bool makePart(const sim::Machine& machine) {
    sim::Machine nominal(machine);
    sim::CycleRun rehearsal(nominal, *cycle_, cycleInputs_, session_.limits(), true);
    rehearsal.run();
    std::vector<verify::Touch> touches;
    for (const sim::ExpectedSurface& one : rehearsal.expected())
      touches.push_back({one.point, one.direction, one.distance});
    if (touches.empty()) return true;
    reportShortTouches(rehearsal.expected());
    const auto part = verify::partOf(touches, cycleInputs_.ballRadius, cycleInputs_.overtravel, {});
    if (!part) {
      diagnostics().report<diag::NoNominalPart>(rehearsal.place());
      return false;
    }
    if (const auto other = meetsAnother(machine, *part, rehearsal.expected())) {
      diagnostics().report<diag::NoNominalPart>(*other);
      return false;
    }
    world_->setPart(*part);
    return madePart_ = true;
  }

  // The first touch whose surface the ball does not come to, where it meets another one: the faces of two
  // touches are in each other's way.
  std::optional<SourceRange> meetsAnother(sim::Machine machine, const sim::Part& part,
                                          const std::vector<sim::ExpectedSurface>& expected) {
    constexpr double kOff = 0.05; // mm: more than a probe is off
    sim::World world(part, world_->probe());
    machine.setSkipSignal(&world);
    machine.setWatcher(&world);
    sim::CycleRun run(machine, *cycle_, cycleInputs_, session_.limits());
    run.run();
    std::vector<sim::Point3> met;
    for (const sim::ProbeEvent& event : world.events())
      if (event.outcome == sim::Outcome::Contact) met.push_back(event.point);
    if (met.size() < expected.size()) return std::nullopt; // the probe is off, or the cycle ends before
    for (const sim::ExpectedSurface& one : expected)
      if (std::none_of(met.begin(), met.end(),
                       [&](const sim::Point3& point) { return (point - one.point).length() < kOff; }))
        return one.range;
    return std::nullopt;
  }

  // A distance that was counted from the ball instead of from its centre: the part then lies within the ball.
  void reportShortTouches(const std::vector<sim::ExpectedSurface>& expected) {
    std::set<std::uint32_t> said;
    for (const sim::ExpectedSurface& one : expected)
      if (one.ball > 0 && one.distance <= one.ball && said.insert(one.range.begin).second)
        diagnostics().report<diag::TouchWithinBall>(one.range, numberText(one.distance),
                                                    numberText(one.ball));
  }

  Outcome runIn(sim::Machine& machine) {
    std::optional<sim::Trace> trace;
    if (options_.trace) machine.setTrace(&trace.emplace(options_.trace));
    sim::CycleRun run(machine, *cycle_, cycleInputs_, session_.limits());
    world_->setPlace([&run] { return sim::RunPlace{run.place(), run.openCalls(), 0}; });
    world_->setSafeMove([&run] { return run.isProtected(); });
    world_->keepOffsets();
    world_->attach(machine);
    run.run();
    machine.setTrace(nullptr);
    if (trace) sim::traceResults(run, *trace);
    trace.reset();
    if (!run.left().empty()) world_->addFound(sim::resultsOf(*cycle_, run));
    sim::reportCycle(run, machine, session_);
    const bool stopped = run.alarmKind() == stdlib::MacroAlarm::PathObstructed ||
                         run.alarmKind() == stdlib::MacroAlarm::ProbeOpen;
    if (madePart_ && (stopped || world_->collisions() > 0)) diagnostics().report<diag::MadePartInTheWay>({});
    world_->reportRest();
    Outcome out = outcomeOf(session_,
                            options_.json    ? sim::cycleSummary(*cycle_, run, machine, *world_, session_)
                            : options_.trace ? world_->measuredTable()
                                             : "",
                            true);
    out.files = world_->pictures();
    return out;
  }

  SimOptions options_;
  Session& session_;
  project::CycleFiles files_;
  std::optional<ir::Cycle> cycle_;
  std::map<std::string, double> sets_, hosts_; // --set; --host, then the job
  std::optional<project::Job> job_;
  std::unique_ptr<sim::SimWorld> world_;
  sim::CycleInputs cycleInputs_;
  bool madePart_ = false;
};

} // namespace

Outcome simCycle(const SimOptions& options, Session& session) {
  return CycleCommand(options, session).run();
}

} // namespace dotek::driver
