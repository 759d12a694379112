// Writing the length of a tool into the table of the control.
#include "backends/fanuc/OwnCycles.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Flow.h"
#include "ir/Match.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::backends::fanuc {
namespace {

constexpr const char* kByHand = "report the value, and correct the tool on the machine";

ir::ExpressionPtr argumentOf(const ir::CallCycle& set, std::string_view parameter) {
  for (const ir::CycleArgument& one : set.arguments)
    if (one.parameter == parameter) return tidy(one.value);
  return nullptr;
}

bool moves(const ir::CycleStatement& statement) {
  return ir::match(
      statement, [](const ir::CallCycle& call) { return call.moves; },
      [](const ir::OneOf<ir::Move, ir::Measure, ir::OpaqueBlock> auto&) { return true; },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::ProbePower, ir::Comment, ir::Assign,
                         ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop,
                         ir::Alarm> auto&) { return false; });
}

// Whether a length that is written counts from the next move or from the next G43 on, a parameter decides.
bool movesAfter(const State& state) {
  const std::vector<ir::CycleStatement>& list = state.cycle.body;
  const std::vector<bool> after = reachableFrom(ir::successors(list), state.at);
  for (std::size_t i = 0; i < list.size(); ++i)
    if (after[i] && moves(list[i])) return true;
  return false;
}

// Makes sure that there is such an offset. false: refused.
bool guardTool(State& state, const ir::ExpressionPtr& tool, const ir::Origin& origin) {
  if (const double* value = ir::constantValue(tool)) {
    if (*value >= 1 && *value <= state.control.variables.toolCount && *value == std::trunc(*value))
      return true;
    state.refuse<diag::CycleStatementCannot>(
        origin.range(), fmt::format("a correction of tool offset {:g}", *value), state.control.title,
        state.macros.title, fmt::format("its table has 1 to {}", state.control.variables.toolCount));
    return false;
  }
  const auto same = [&](const ir::ExpressionPtr& other) { return ir::equal(other, tool); };
  if (std::any_of(state.tools.begin(), state.tools.end(), same)) return true;
  const std::set<ir::VariableId> ids = variablesOf(tool);
  // What may be left out is looked at where it is used.
  const bool mayMiss = std::any_of(ids.begin(), ids.end(), [&](ir::VariableId id) {
    return state.cycle.variable(id).optional && !state.cycle.variable(id).defaultValue;
  });
  if (!mayMiss && knownAtEntry(state, tool))
    state.tools.push_back(tool);
  else
    writeToolAlarm(state, tool, origin);
  return true;
}

} // namespace

void writeToolAlarm(State& state, const ir::ExpressionPtr& tool, const ir::Origin& given) {
  ir::Origin origin;
  origin.ranges = given.ranges;
  origin.reason = "range of the tool offset";
  const std::string text = fmt::format("TOOL OFFSET NOT 1 TO {}", state.control.variables.toolCount);
  const auto last = ir::constant(state.control.variables.toolCount);
  alarmIf(state, ir::compare(ir::Relation::Less, tool, ir::constant(1)), text, origin);
  alarmIf(state, ir::compare(ir::Relation::Greater, tool, last), text, origin);
  alarmIf(state, ir::compare(ir::Relation::NotEqual, tool, ir::unary(ir::UnaryOp::Truncate, tool)), text,
          origin);
  state.releaseHelpers();
}

void writeSetTool(State& state, const ir::CallCycle& set, const ir::Origin& given) {
  const stdlib::SystemVariables& v = state.control.variables;
  const auto refuse = [&](const char* what, const char* remedy) {
    state.refuse<diag::CycleStatementCannot>(given.range(), what, state.control.title, state.macros.title,
                                             remedy);
  };
  const ir::ExpressionPtr tool = argumentOf(set, "tool"), length = argumentOf(set, "length");
  const std::optional<int> first = v.toolGeometry ? v.toolGeometry : v.toolWear;
  if (tool == nullptr || length == nullptr) return refuse("a correction of the radius of a tool", kByHand);
  if (!first) return refuse("a correction of a tool", kByHand);
  // A dialog does not know how many offsets the table has, and a post looks at nothing.
  if (state.options.branch)
    return refuse("a correction of a tool by a post",
                  "write the program with `--to fanuc`, and have it called");
  if (movesAfter(state))
    return refuse(
        "a move after the length of a tool is set",
        "set it after the last move: when the control takes a new length is a parameter of its own");
  if (!guardTool(state, tool, given)) return;
  ir::Origin origin = given;
  origin.reason = "length of the tool";
  writeWait(state, origin);
  const auto put = [&](int base, const ir::ExpressionPtr& value) {
    const ir::ExpressionPtr number = tidy(ir::binary(ir::BinaryOp::Add, ir::constant(base), tool));
    const std::string left = machineText(state, number, origin);
    assign(state, left, value, origin);
    state.releaseHelpers();
  };
  put(*first, length);
  if (v.toolGeometry && v.toolWear) put(*v.toolWear, ir::constant(0));
  if (!state.reported.insert("tool length").second) return;
  state.remarks.push_back(v.toolGeometry && v.toolWear
                              ? "SETS THE GEOMETRY OF A TOOL LENGTH, AND ITS WEAR TO 0: GIVE G43 ANEW"
                              : "SETS A TOOL LENGTH: GIVE G43 ANEW");
}

} // namespace dotek::backends::fanuc
