// A cycle as a program on the control: the fragment calls it and carries its text.
#include "backends/fusion/State.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <fmt/format.h>

namespace dotek::backends::fusion {

namespace {

using stdlib::Function;

ir::Origin originOf(const ir::Variable& variable) {
  ir::Origin out;
  if (variable.range.hasPlace()) out.ranges = {variable.range};
  return out;
}

// `var depthText = ..;`: the text of a value, checked; `before`: what it gets before it.
std::string textOf(State& state, const std::string& value, std::string_view what, std::string_view before,
                   bool mayBeAbsent, const ir::Origin& origin) {
  const std::string name = state.names.take(value + "Text");
  const std::string number = state.helper(Helper::Number) + "(" + value + ")";
  if (mayBeAbsent) {
    state.script.add("var " + name + " = \"\";", origin);
    state.script.open("if (" + value + " !== undefined) {", origin);
  }
  state.script.add((mayBeAbsent ? "" : "var ") + name + " = " + number + ";", origin);
  state.errorIf(name + " === null", std::string(what) + " has too many digits for the control", origin);
  state.script.add(
      state.helper(Helper::Loses) + "(" + quoted(what) + ", " + value + ", Number(" + name + "));", origin);
  if (!before.empty()) state.script.add(name + " = " + quoted(before) + " + " + name + ";", origin);
  if (mayBeAbsent) state.script.close();
  return name;
}

// What only the control can compare it compares: the program has all checks.
void writeChecksOrNone(State& state) {
  Diagnostics said = std::exchange(state.diagnostics, Diagnostics());
  const Script script = state.script;
  const auto names = state.names;
  const auto named = state.named;
  const auto read = state.read;
  const auto helpers = state.helpers;
  writeChecks(state);
  std::swap(said, state.diagnostics);
  if (!state.failed) {
    for (Diagnostic& one : said.all())
      state.diagnostics.add(std::move(one));
    return;
  }
  state.failed = false;
  state.script = script;
  state.names = names;
  state.named = named;
  state.read = read;
  state.helpers = helpers;
  state.script.comment(kChecksOfProgram);
}

std::string codeOf(State& state, Function function, std::string_view what) {
  const stdlib::CodeInfo* found = state.options.control.find(function);
  if (found != nullptr) return std::string(1, found->letter) + numberText(found->tenths / 10.0);
  state.refuse<diag::NoCode>(state.cycle.range, state.options.control.title, what);
  return "";
}

} // namespace

bool mayBeLeftOut(const State& state, ir::VariableId id) {
  const ir::Variable& variable = state.cycle.variable(id);
  return state.options.call && variable.role == ir::Role::Parameter && variable.optional &&
         !variable.defaultValue;
}

void writeCall(State& state) {
  const ProgramCall& call = *state.options.call;
  // Before the checks, which compute defaults that are rules: what is not given stays out of the call.
  std::string words;
  for (const ProgramCall::Argument& argument : call.arguments) {
    const ir::Variable& variable = state.cycle.variable(argument.variable);
    const std::string letter = std::string(" ") + argument.letter;
    words += " + " + textOf(state, state.name(argument.variable), variable.name, letter,
                            mayBeLeftOut(state, argument.variable), originOf(variable));
  }
  writeChecksOrNone(state);
  const auto host = [&](const char* name) { return std::string(state.name(state.host(name))); };
  const std::string x = host("start_x"), y = host("start_y"), z = host("start_z");
  const std::string clearance = host("clearance");
  state.errorIf(clearance + " < " + z, "the clearance plane lies below the point, where the cycle starts",
                {});
  const auto place = [&](const std::string& value) { return textOf(state, value, value, "", false, {}); };
  const std::string up = place(clearance), atX = place(x), atY = place(y), down = place(z);
  const std::string absolute = codeOf(state, Function::Absolute, "absolute distances");
  const std::string rapid = codeOf(state, Function::Rapid, "rapid moves");
  state.script.add(state.prefix + "_called = true;");
  state.script.comment("Above all, over the point, down to where the cycle starts.");
  state.script.add("writeBlock(" + quoted(absolute + " " + rapid + " Z") + " + " + up + ");");
  state.script.add("writeBlock(\"X\" + " + atX + " + \" Y\" + " + atY + ");");
  state.script.add("writeBlock(\"Z\" + " + down + ");");
  state.script.add("writeBlock(" + quoted("G65 P" + std::to_string(call.number)) + words + ");");
  for (const char* output : {"xOutput", "yOutput", "zOutput", "feedOutput", "gMotionModal"})
    state.script.add(std::string(output) + ".reset();");
}

void writeProgram(State& state) {
  const ProgramCall& call = *state.options.call;
  Script& script = state.script;
  script.add("var " + state.prefix + "_called = false;");
  script.blank();
  script.add("// The program that the operation calls.");
  script.open("function " + state.prefix + "_program() {");
  for (const EmittedLine& line : call.lines) {
    ir::Origin origin;
    origin.ranges = line.ranges;
    origin.reason = line.reason;
    script.add("writeln(" + quoted(line.text) + ");", origin);
  }
  script.close();
  script.blank();
  script.add("// For the end of onClose: the program where an operation calls it.");
  script.open("function " + state.prefix + "_close() {");
  script.open("if (" + state.prefix + "_called) {");
  script.add(state.prefix + "_program();");
  script.close();
  script.close();
  script.blank();
}

} // namespace dotek::backends::fusion
