#include "frontend/mikroprog/Motion.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace dotek::frontend::mikroprog {

namespace {

constexpr std::string_view kAxes = "XYZ";

// The coordinate at the end of the block along an axis that it names; nothing: not known.
std::optional<double> targetOf(const MotionState& state, const Line& line, std::size_t axis,
                               const stdlib::MikroprogControl& control) {
  const Word* word = line.find(kAxes[axis]);
  if (word == nullptr || !word->value.number || !state.absolute) return std::nullopt;
  double value = *word->value.number;
  if (control.isDiameter(kAxes[axis])) {
    if (!state.radius || !*state.absolute) return std::nullopt; // how a distance counts is not known (Q9)
    if (!*state.radius) value /= 2;
  }
  if (*state.absolute) return value;
  return state.at[axis] ? std::optional(*state.at[axis] + value) : std::nullopt;
}

void forget(MotionState& state) {
  state.at = {};
  state.absolute.reset();
  state.radius.reset();
  state.compensated = false;
  state.feedValue.reset();
  state.speed.reset();
  state.turning.reset();
  state.direction = 0;
  state.reversed = false;
  state.perRevolution.reset();
  state.constantSpeed.reset();
  state.coolant.reset();
  state.shift = nullptr;
  state.joined = false;
}

constexpr double kReversal = 5; // s, of G4 after a reversal of the spindle

void enterSpindle(MotionState& state, const Block& block) {
  const char direction = block.does("spindle-right") ? '3' : block.does("spindle-left") ? '4' : '\0';
  if (const Word* word = block.line->find('S'); word != nullptr && !block.does("surface-speed")) {
    state.speed = word->value.number;
    state.constantSpeed = false; // a new S ends G96
    if (state.speed == 0.0) state.turning = false;
  }
  if (direction != '\0' && state.speed != 0.0) {
    if (state.direction != 0 && state.direction != direction) {
      state.reversed = true;
      state.waited = 0;
    }
    state.direction = direction;
    state.turning = true;
  }
  if (block.does("spindle-off")) state.turning = false;
  if (block.does("surface-speed")) state.constantSpeed = true;
  if (block.does("reference")) state.constantSpeed = false;
  if (block.does("dwell")) {
    const Word* seconds = block.line->find('E');
    state.waited += seconds != nullptr ? seconds->value.number.value_or(kReversal) : 0;
    if (state.waited >= kReversal) state.reversed = false;
  }
}

// What the codes of the block put in force.
void enter(MotionState& state, const Block& block) {
  if (block.hasUnknownCode()) forget(state);
  if (const Word* feed = block.line->find('F'); feed != nullptr) {
    state.feed = true;
    state.feedValue = feed->value.number;
  }
  enterSpindle(state, block);
  if (block.does("feed-per-minute")) state.perRevolution = false;
  if (block.does("feed-per-revolution")) state.perRevolution = true;
  if (block.does("coolant-on")) state.coolant = true;
  if (block.does("coolant-off")) state.coolant = false;
  if (block.does("join-on")) state.joined = true;
  if (block.does("join-off")) state.joined = false;
  if (block.does("system-off")) state.shift = nullptr;
  if (block.does("plane-xy")) state.plane = "XY";
  if (block.does("plane-zx")) state.plane = "XZ";
  if (block.does("plane-yz")) state.plane = "YZ";
  if (block.does("radius")) state.radius = true;
  if (block.does("absolute")) {
    state.absolute = true;
    state.radius = false; // G90 ends G24
  }
  if (block.does("incremental")) state.absolute = false;
  if (block.does("compensation-off")) state.compensated = false;
  if (block.does("compensation-left") || block.does("compensation-right")) state.compensated = true;
  for (const Code& code : block.codes)
    if (code.function != nullptr && code.function->group == "motion") state.motion = code.function->function;
  for (const Code& code : block.codes)
    if (code.function != nullptr && code.function->group == "system" && !block.does("system-off"))
      state.shift = code.function;
}

// Where the tool is after the block.
void leave(MotionState& state, const Block& block, const stdlib::MikroprogControl& control) {
  for (const std::string_view leads : {"jump", "return", "end", "leave", "call", "run-program", "run-macro"})
    if (block.does(leads)) return forget(state);
  const bool elsewhere = std::any_of(block.codes.begin(), block.codes.end(), [](const Code& code) {
    return code.function != nullptr &&
           (code.function->function == "reference" || code.function->function == "tool-change" ||
            code.function->function.starts_with("system-"));
  });
  if (elsewhere) state.at = {};
  const bool known = onlyMoves(block) || (block.does("set-position") && state.absolute.value_or(false));
  std::array<std::optional<double>, 3> to = state.at;
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (block.line->find(kAxes[axis]) == nullptr) continue;
    // After a contact or a cycle no source says where the tool is.
    to[axis] = known ? targetOf(state, *block.line, axis, control) : std::nullopt;
  }
  state.at = to;
}

} // namespace

std::optional<double> MotionState::travel(const Line& line, char axis,
                                          const stdlib::MikroprogControl& control) const {
  const std::size_t index = kAxes.find(axis);
  if (index == std::string_view::npos) return std::nullopt;
  const std::optional<double> to = targetOf(*this, line, index, control);
  return to && at[index] ? std::optional(*to - *at[index]) : std::nullopt;
}

bool hasAxisWord(const Block& block, const stdlib::MikroprogControl& control) {
  return std::any_of(control.axes.begin(), control.axes.end(),
                     [&](char axis) { return block.line->find(axis) != nullptr; });
}

bool isCut(const Block& block, const MotionState& state, const stdlib::MikroprogControl& control) {
  if (block.does("cycle")) return true;
  return state.motion != "rapid" && hasAxisWord(block, control) && onlyMoves(block);
}

bool onlyMoves(const Block& block) {
  return std::all_of(block.codes.begin(), block.codes.end(), [](const Code& code) {
    return code.function == nullptr || code.function->group == "motion" || code.function->addresses.empty();
  });
}

namespace {

// By block; nothing for one that was not read.
std::vector<std::optional<MotionState>> statesOf(const Reading& reading) {
  std::set<double> targets; // N numbers that a jump names
  for (const Line& line : reading.program.lines)
    if (const Word* target = line.find('L'); target != nullptr && target->value.number)
      targets.insert(*target->value.number);
  std::vector<std::optional<MotionState>> out;
  out.reserve(reading.blocks.size());
  MotionState state;
  if (reading.control.isDiameter('X')) state.plane = "XZ"; // of a lathe, from the start
  for (const Block& block : reading.blocks) {
    const Line& line = *block.line;
    if (line.number && targets.contains(static_cast<double>(*line.number))) forget(state);
    if (line.unread) {
      forget(state);
      out.emplace_back();
      continue;
    }
    enter(state, block);
    out.emplace_back(state);
    leave(state, block, reading.control);
  }
  return out;
}

} // namespace

void walkMotion(const Reading& reading,
                const std::function<void(const Block& block, const MotionState& state)>& visit) {
  std::call_once(reading.motion.once, [&] {
    reading.motion.states =
        std::make_shared<const std::vector<std::optional<MotionState>>>(statesOf(reading));
  });
  const std::vector<std::optional<MotionState>>& states = *reading.motion.states;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i]) visit(reading.blocks[i], *states[i]);
}

} // namespace dotek::frontend::mikroprog
