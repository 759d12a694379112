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
}

// What the codes of the block put in force.
void enter(MotionState& state, const Block& block) {
  if (block.hasUnknownCode()) forget(state);
  if (block.line->find('F') != nullptr) state.feed = true;
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

bool onlyMoves(const Block& block) {
  return std::all_of(block.codes.begin(), block.codes.end(), [](const Code& code) {
    return code.function == nullptr || code.function->group == "motion" || code.function->addresses.empty();
  });
}

void walkMotion(const Reading& reading,
                const std::function<void(const Block& block, const MotionState& state)>& visit) {
  std::set<double> targets; // N numbers that a jump names
  for (const Line& line : reading.program.lines)
    if (const Word* target = line.find('L'); target != nullptr && target->value.number)
      targets.insert(*target->value.number);
  MotionState state;
  if (reading.control.isDiameter('X')) state.plane = "XZ"; // of a lathe, from the start
  for (const Block& block : reading.blocks) {
    const Line& line = *block.line;
    if (line.number && targets.contains(static_cast<double>(*line.number))) forget(state);
    if (line.unread) {
      forget(state);
      continue;
    }
    enter(state, block);
    visit(block, state);
    leave(state, block, reading.control);
  }
}

} // namespace dotek::frontend::mikroprog
