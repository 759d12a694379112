#include "ir/Dataflow.h"
#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>
#include <utility>

namespace dotek::lint::rule {
namespace {

// Axes of a move; a call of a protected move included.
template <ir::AnyStatement Statement> AxisSet movedBy(const Statement& statement, const Probing& probing) {
  return match(
      statement,
      [](const ir::Move& move) {
        return static_cast<AxisSet>((move.axes[0] ? 1 : 0) | (move.axes[1] ? 2 : 0) | (move.axes[2] ? 4 : 0));
      },
      [](const ir::NcBlock& block) { return isPlainMove(block) ? axesOf(block) : AxisSet{0}; },
      [&](const ir::Call& call) {
        AxisSet out = 0;
        if (probing.step(statement).kind != ProbeStep::Kind::Protected) return out;
        for (const ir::CallArgument& argument : call.arguments)
          if (argument.letter >= 'X' && argument.letter <= 'Z')
            out = static_cast<AxisSet>(out | (1U << (argument.letter - 'X')));
        return out;
      },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Measure, ir::CallCycle,
                         ir::ProbePower, ir::Comment, ir::Assign, ir::Return, ir::Spindle, ir::Coolant,
                         ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::JumpTo, ir::Loop,
                         ir::LoopEnd, ir::Exit, ir::Raise, ir::Notice, ir::Port, ir::Print,
                         ir::NameVariables> auto&) { return AxisSet{0}; });
}

// A branch that goes to where its touches say the middle is stays within what it has touched.
template <ir::AnyStatement Statement> bool goesToMeasured(const Statement& statement) {
  constexpr double kFirstOfSystem = 1000;
  bool found = false;
  if constexpr (std::same_as<Statement, ir::CycleStatement>)
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* machine = std::get_if<ir::MachineVariable>(&node.node);
      const double* number = machine == nullptr ? nullptr : ir::constantValue(machine->number);
      found = found || (number != nullptr && *number < kFirstOfSystem) ||
              std::holds_alternative<ir::MeasuredResult>(node.node);
    });
  return found;
}

struct Travel {
  std::size_t at = 0;
  bool lifted = false;
};

// Moves along X or Y after a measurement, up to the next one: the first of each, and whether a move along Z
// alone is between.
template <ir::AnyStatement Statement>
std::vector<Travel> travels(const std::vector<Statement>& body, const Probing& probing) {
  std::vector<Travel> out;
  bool measured = false;
  bool lifted = false;
  bool armed = false; // G66 is in force
  bool level = false; // it has gone along X or Y at this height before
  for (std::size_t i = 0; i < body.size(); ++i) {
    // G66 only says what runs after the moves that follow, and that macro knows its own way back.
    if constexpr (std::same_as<Statement, ir::ProgramStatement>) {
      const auto* call = std::get_if<ir::Call>(&body[i].node);
      if (call != nullptr && call->kind != ir::CallKind::Macro && call->kind != ir::CallKind::Subprogram) {
        armed = call->kind != ir::CallKind::Off;
        measured = false;
        continue;
      }
    }
    if (armed) continue;
    const ProbeStep step = probing.step(body[i]);
    if (step.kind == ProbeStep::Kind::Measure ||
        (step.kind == ProbeStep::Kind::OwnCall && probing.skips(step.program))) {
      measured = !endsAbove(body[i]);
      lifted = step.kind == ProbeStep::Kind::OwnCall && probing.liftsAfter(step.program);
      continue;
    }
    const AxisSet axes = movedBy(body[i], probing);
    if (axes == 4) lifted = true;
    const bool free = std::exchange(level, (axes & 4) == 0 && (level || axes != 0));
    if (!measured || axes == 0 || axes == 4 || goesToMeasured(body[i])) continue;
    if (lifted || !free) out.push_back({i, lifted});
    measured = false;
  }
  return out;
}

template <ir::AnyStatement Statement>
void checkBody(const std::vector<Statement>& body, const Probing& probing, Report& report) {
  const std::vector<Travel> all = travels(body, probing);
  const Travel* lifted = nullptr;
  for (const Travel& travel : all)
    if (travel.lifted) lifted = &travel;
  if (lifted == nullptr) return;
  for (const Travel& travel : all)
    if (!travel.lifted)
      report
          .at(body[travel.at].origin.range(),
              "this travel follows a measurement without taking the probe up first, as the others do; the "
              "stylus "
              "goes through the part at the depth of the touch; write the move along Z before it")
          .note(body[lifted->at].origin.range(), "here a move along Z is before");
}

void check(const Project& project, Report& report) {
  for (const Joined& joined : project.joined)
    if (joined.lowered) checkBody(joined.lowered->body, probingOf(project), report);
}

void checkProgram(const NcProgram& nc, Report& report) {
  // A macro that touches one feature knows its own paths.
  if (endsProgram(nc.program)) checkBody(nc.program.body, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(retract_left_out){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
    .program = checkProgram,
};

} // namespace dotek::lint::rule
