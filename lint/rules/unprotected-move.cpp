#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <algorithm>
#include <optional>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::array<std::string_view, 2> kAxes = {"X", "Y"};

// Whether the stylus is among the part: after a protected move or a measurement, until a plain move along Z
// alone, which is how a probe is taken up, or until it is switched off.
struct State {
  bool down = false;
  bool measured = false;   // and no move along Z since
  int motion = -1;         // G0 0, G1 1, others and unknown -1
  std::optional<double> z; // of the last protected move along Z, where it is written out
};

// Z of a protected move that goes along no other axis; an empty value inside where it is computed.
std::optional<std::optional<double>> zOf(const ir::Move& move) {
  if (move.axes[0] || move.axes[1] || !move.axes[2]) return std::nullopt;
  const double* value = ir::constantValue(move.axes[2]->value);
  return value == nullptr ? std::optional<double>() : std::optional(*value);
}

std::optional<std::optional<double>> zOf(const ir::Call& call) {
  std::optional<std::optional<double>> z;
  for (const ir::CallArgument& argument : call.arguments) {
    if (argument.letter == 'X' || argument.letter == 'Y') return std::nullopt;
    const double* value = argument.letter == 'Z' ? ir::constantValue(argument.value) : nullptr;
    if (argument.letter == 'Z') z = value == nullptr ? std::optional<double>() : std::optional(*value);
  }
  return z;
}

template <ir::AnyStatement Statement>
std::optional<std::optional<double>> protectedZ(const Statement& statement) {
  return match(
      statement, [](const ir::OneOf<ir::Move, ir::Call> auto& node) { return zOf(node); },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Measure, ir::CallCycle,
                         ir::ProbePower, ir::Comment, ir::Assign, ir::Return, ir::Spindle, ir::Coolant,
                         ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::NcBlock,
                         ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Exit, ir::Raise, ir::Notice, ir::Port,
                         ir::Print, ir::NameVariables> auto&) {
        return std::optional<std::optional<double>>();
      });
}

// Down unless it leads up: higher than before, or, where that is not written out, the first one after a
// measurement.
void moveAlongZ(State& state, const std::optional<double>& z) {
  if (z && state.z)
    state.down = *z < *state.z || (state.down && *z == *state.z);
  else
    state.down = !state.measured;
  state.z = z;
  state.measured = false;
}

struct Motion {
  bool rapid = false;
  bool plain = false; // G0 or G1, stated here or in force
  bool xy = false;
  bool z = false;
};

Motion motionOf(const ir::Move& move) {
  Motion out;
  out.plain = move.motion != ir::Motion::Protected;
  out.rapid = move.motion == ir::Motion::Rapid;
  const auto inPart = [&](std::size_t axis) {
    return move.axes[axis] && move.axes[axis]->frame != ir::Frame::Machine;
  };
  out.xy = inPart(0) || inPart(1);
  out.z = move.axes[2].has_value();
  return out;
}

Motion motionOf(const ir::NcBlock& block, const State& before) {
  Motion out;
  for (const double code : {4.0, 10.0, 28.0, 30.0, 31.0, 52.0, 53.0, 65.0, 92.0})
    if (hasCode(block, 'G', code)) return out;
  const bool rapid = hasCode(block, 'G', 0);
  const bool feed = hasCode(block, 'G', 1);
  const bool arc = hasCode(block, 'G', 2) || hasCode(block, 'G', 3);
  out.plain = !arc && (rapid || feed || before.motion >= 0);
  out.rapid = rapid || (!feed && before.motion == 0);
  out.xy = hasWord(block, 'X') || hasWord(block, 'Y');
  out.z = hasWord(block, 'Z');
  return out;
}

template <ir::AnyStatement Statement> Motion motionOf(const Statement& statement, const State& before) {
  return match(
      statement, [](const ir::Move& move) { return motionOf(move); },
      [&](const ir::NcBlock& block) { return motionOf(block, before); },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Measure, ir::CallCycle,
                         ir::ProbePower, ir::Comment, ir::Assign, ir::Return, ir::Spindle, ir::Coolant,
                         ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::JumpTo, ir::Loop,
                         ir::LoopEnd, ir::Call, ir::Exit, ir::Raise, ir::Notice, ir::Port, ir::Print,
                         ir::NameVariables> auto&) { return Motion{}; });
}

// What G codes and a tool change make of it.
void passBlock(State& state, const ir::NcBlock& block) {
  for (const double code : {28.0, 30.0, 53.0})
    if (hasCode(block, 'G', code)) state.down = false;
  if (hasCode(block, 'M', 6)) state.down = false;
  for (const ir::Word& word : block.words) {
    const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
    if (code != nullptr && *code >= 0 && *code <= 3) state.motion = *code <= 1 ? static_cast<int>(*code) : -1;
  }
}

const ir::NcBlock* blockOf(const ir::CycleStatement&) {
  return nullptr;
}
const ir::NcBlock* blockOf(const ir::ProgramStatement& statement) {
  return std::get_if<ir::NcBlock>(&statement.node);
}

template <ir::AnyStatement Statement>
void checkBody(const std::vector<Statement>& body, const Probing& probing, Report& report) {
  const auto states = ir::factsBefore<State>(
      body, State{},
      [&](std::size_t at, std::size_t, State state) {
        const ProbeStep::Kind kind = probing.step(body[at]).kind;
        if (kind == ProbeStep::Kind::Measure) {
          state.measured = true;
          state.down = !endsAbove(body[at]);
        }
        if (kind == ProbeStep::Kind::Protected)
          if (const auto z = protectedZ(body[at])) moveAlongZ(state, *z);
        if (kind == ProbeStep::Kind::Off || kind == ProbeStep::Kind::Call || kind == ProbeStep::Kind::OwnCall)
          state.down = false;
        if (kind == ProbeStep::Kind::Call || kind == ProbeStep::Kind::PackCall ||
            kind == ProbeStep::Kind::OwnCall)
          state.motion = -1;
        if (const ir::NcBlock* block = blockOf(body[at])) passBlock(state, *block);
        const Motion motion = motionOf(body[at], state);
        if (motion.plain && motion.z && !motion.xy) state.down = false;
        return state;
      },
      [](State& into, State other) {
        const State before = into;
        into.down = into.down && other.down;
        into.measured = into.measured || other.measured;
        if (into.motion != other.motion) into.motion = -1;
        if (into.z != other.z) into.z.reset();
        return into.down != before.down || into.motion != before.motion || into.measured != before.measured ||
               into.z != before.z;
      });
  std::set<std::uint32_t> told;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!states[i] || !states[i]->down) continue;
    const Motion motion = motionOf(body[i], *states[i]);
    if (!motion.plain || !motion.xy || !told.insert(body[i].origin.range().begin).second) continue;
    report.at(body[i].origin.range(),
              "the stylus is down, and this {} goes along {} or {} without watching it; where "
              "the part is in the way the stylus breaks; take the probe up first, or use the "
              "protected move",
              motion.rapid ? "rapid move" : "feed move", kAxes[0], kAxes[1]);
  }
}

void check(const Project& project, Report& report) {
  for (const Joined& joined : project.joined)
    if (joined.lowered) checkBody(joined.lowered->body, probingOf(project), report);
}

void checkProgram(const NcProgram& nc, Report& report) {
  const Probing& probing = probingOf(nc.project);
  // A macro of a probing pack is what moves the stylus: G31 and its retreats are its business.
  if (probing.probes(nc.program)) checkBody(nc.program.body, probing, report);
}

} // namespace

DOTEK_LINT_RULE(unprotected_move){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
    .program = checkProgram,
};

} // namespace dotek::lint::rule
