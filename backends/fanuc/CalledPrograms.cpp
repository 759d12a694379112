// Calls of the programs that a called cycle has become.
#include "backends/fanuc/State.h"
#include "ir/CycleNames.h"
#include "support/Decimal.h"

#include <algorithm>

namespace dotek::backends::fanuc {
namespace {

Form formOf(ir::Kind kind) {
  const bool selects = kind == ir::Kind::WorkOffset || kind == ir::Kind::ToolOffset ||
                       kind == ir::Kind::Count || kind == ir::Kind::Flag;
  return selects ? Form::Selector : Form::Length;
}

// A word of a call loses what a constant has beyond the last place of the control; a formula does not.
bool isRounded(const State& state, double value) {
  return Decimal::of(value).rounded(state.control.decimals).value() != Decimal::of(value).value();
}

} // namespace

const CalledProgram* calledProgram(const State& state, const ir::CallCycle& call) {
  if (call.cycle != ir::kProgram) return nullptr;
  const auto named = std::find_if(call.arguments.begin(), call.arguments.end(),
                                  [](const auto& one) { return one.parameter == ir::kCalledProgram; });
  const double* index = named == call.arguments.end() ? nullptr : ir::constantValue(named->value);
  if (index == nullptr || !(*index >= 0 && *index < static_cast<double>(state.options.programs.size())))
    return nullptr;
  return &state.options.programs[static_cast<std::size_t>(*index)];
}

void writeProgramCall(State& state, const CalledProgram& program, const ir::CallCycle& call,
                      const ir::Origin& origin) {
  // In the order of the alphabet: of I, J and K out of it the control reads the second set.
  std::vector<Argument> arguments = program.arguments;
  std::sort(arguments.begin(), arguments.end(),
            [](const Argument& a, const Argument& b) { return a.letter < b.letter; });
  std::string text = "G65 P" + std::to_string(program.number);
  for (const Argument& argument : arguments) {
    const ir::Variable& variable = program.cycle->variable(argument.variable);
    const auto given = std::find_if(call.arguments.begin(), call.arguments.end(),
                                    [&](const auto& one) { return one.parameter == variable.name; });
    if (given == call.arguments.end()) continue; // it is absent, or has its default
    const ir::ExpressionPtr value = tidy(given->value);
    // What the called program would refuse is refused before anything moves.
    if (variable.kind == ir::Kind::WorkOffset) guardSystem(state, value, origin);
    if (variable.kind == ir::Kind::ToolOffset && !guardTool(state, value, origin)) return;
    const double* constant = ir::constantValue(value);
    text += ' ';
    if (constant != nullptr && isRounded(state, *constant))
      text += std::string(1, argument.letter) + "[" + numberText(*constant) + "]";
    else
      text += word(state, argument.letter, value, formOf(variable.kind), origin);
  }
  if (call.setting) {
    state.writesOffset = true;
    if (call.setting->axes[ir::indexOf(ir::Axis::Z)]) state.shiftOfZ = true;
  }
  state.sheet.add(text, origin);
}

} // namespace dotek::backends::fanuc
