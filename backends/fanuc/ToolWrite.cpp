// Parts of a tool offset in the table of the control.
#include "backends/common/ToolCorrection.h"
#include "backends/fanuc/OwnCycles.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/CycleNames.h"
#include "ir/Flow.h"
#include "ir/Match.h"
#include "stdlib/RadiusOffsets.h"
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
                         ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                         ir::Port, ir::Print> auto&) { return false; });
}

// Whether a length that is written counts from the next move or from the next G43 on, a parameter decides.
bool movesAfter(const State& state) {
  const std::vector<ir::CycleStatement>& list = state.cycle.body;
  const std::vector<bool> after = reachableFrom(ir::successors(list), state.at);
  for (std::size_t i = 0; i < list.size(); ++i)
    if (after[i] && moves(list[i])) return true;
  return false;
}

} // namespace

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
  if (knownAtEntry(state, tool))
    state.tools.push_back(tool);
  else
    writeToolAlarm(state, tool, origin);
  return true;
}

void writeToolAlarm(State& state, const ir::ExpressionPtr& tool, const ir::Origin& given) {
  ir::Origin origin;
  origin.ranges = given.ranges;
  origin.reason = "range of the tool offset";
  const std::string text = fmt::format("TOOL OFFSET NOT 1 TO {}", state.control.variables.toolCount);
  const auto last = ir::constant(state.control.variables.toolCount);
  // What the caller may leave out is looked at where he gives it.
  const auto check = [&](ir::ConditionPtr wrong) {
    for (const ir::VariableId id : variablesOf(tool))
      if (state.cycle.variable(id).optional && !state.cycle.variable(id).defaultValue)
        wrong = ir::join(ir::Connective::And, ir::negate(ir::isNull(ir::variable(id))), std::move(wrong));
    alarmIf(state, wrong, text, origin);
  };
  check(ir::compare(ir::Relation::Less, tool, ir::constant(1)));
  check(ir::compare(ir::Relation::Greater, tool, last));
  check(ir::compare(ir::Relation::NotEqual, tool, ir::unary(ir::UnaryOp::Truncate, tool)));
  state.releaseHelpers();
}

namespace {

// Where the table has a length or a radius. `wear` alone: in one memory the whole of it.
struct Registers {
  std::optional<int> geometry, wear;
  bool hasWear() const { return geometry && wear; }
};

Registers registersOf(const stdlib::Control& control, ir::ToolPart part) {
  const stdlib::SystemVariables& v = control.variables;
  if (isLength(part)) return {v.toolGeometry, v.toolWear};
  const stdlib::RadiusOffsets radii = stdlib::radiusOffsets(control);
  return {radii.geometry, radii.wear};
}

// "the wear of the radius of a tool"
std::string titleOf(ir::ToolPart part) {
  return fmt::format("the {}{} of a tool", isWear(part) ? "wear of the " : "",
                     isLength(part) ? "length" : "radius");
}

// The table has such a part, and what is written can reach it. false: refused.
bool hasPart(State& state, ir::ToolPart part, const ir::Origin& origin) {
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    state.refuse<diag::CycleStatementCannot>(origin.range(), what, state.control.title, state.macros.title,
                                             remedy);
    return false;
  };
  const Registers at = registersOf(state.control, part);
  if (!at.geometry && !at.wear)
    return refuse(titleOf(part), fmt::format("its profile does not say where the table has it; {}", kByHand));
  if (isWear(part) && !at.hasWear())
    return refuse(titleOf(part), "its table has one value for each; read and set that as a whole");
  // A dialog does not know how many offsets the table has, and a post looks at nothing.
  if (state.options.branch)
    return refuse(titleOf(part) + " in a post", "write the program with `--to fanuc`, and have it called");
  return true;
}

ir::ExpressionPtr entryOf(int base, const ir::ExpressionPtr& tool) {
  return tidy(ir::binary(ir::BinaryOp::Add, ir::constant(base), tool));
}

// What a table of radii may hold is a parameter of the control.
void remarkRadius(State& state) {
  if (state.reported.insert("tool radius").second)
    state.remarks.push_back("THE TABLE OF TOOL OFFSETS HOLDS RADII, NO DIAMETERS");
}

} // namespace

void writeSetTool(State& state, const ir::CallCycle& set, const ir::Origin& given) {
  const ir::ExpressionPtr tool = argumentOf(set, "tool");
  ir::ToolPart part = ir::ToolPart::Length;
  ir::ExpressionPtr value;
  for (const ir::ToolPart one : ir::kToolParts)
    if (ir::ExpressionPtr found = argumentOf(set, toolPartText(one))) {
      part = one;
      value = std::move(found);
    }
  if (tool == nullptr || value == nullptr || !hasPart(state, part, given)) return;
  if (isLength(part) && movesAfter(state)) {
    state.refuse<diag::CycleStatementCannot>(
        given.range(), "a move after the length of a tool is set", state.control.title, state.macros.title,
        "set it after the last move: when the control takes a new length is a parameter of its own");
    return;
  }
  if (!guardTool(state, tool, given)) return;
  ir::Origin origin = given;
  origin.reason = isLength(part) ? "length of the tool" : "radius of the tool";
  writeWait(state, origin);
  const auto put = [&](int base, const ir::ExpressionPtr& to) {
    const std::string left = machineText(state, entryOf(base, tool), origin);
    assign(state, left, to, origin);
    state.releaseHelpers();
  };
  const Registers at = registersOf(state.control, part);
  if (isWear(part)) {
    put(*at.wear, value);
  } else {
    put(at.geometry ? *at.geometry : *at.wear, value);
    if (at.hasWear()) put(*at.wear, ir::constant(0));
  }
  if (!isLength(part)) remarkRadius(state);
  if (!state.reported.insert(std::string("set ") + std::string(toolPartText(part))).second) return;
  const std::string_view name = isLength(part) ? "LENGTH" : "RADIUS";
  state.remarks.push_back(isWear(part) ? fmt::format("SETS THE WEAR OF A TOOL {}", name)
                          : at.hasWear()
                              ? fmt::format("SETS THE GEOMETRY OF A TOOL {}, AND ITS WEAR TO 0", name)
                              : fmt::format("SETS A TOOL {}", name));
  if (isLength(part)) state.remarks.back() += ": GIVE G43 ANEW";
}

void writeToolCorrection(State& state, const ToolCorrection& correction, const ir::Origin& given) {
  const ir::ExpressionPtr tool = tidy(correction.tool);
  const Registers at = registersOf(state.control, ir::ToolPart::Length);
  const std::optional<int> base = correction.geometry && at.geometry ? at.geometry : at.wear;
  if (!base) {
    hasPart(state, ir::ToolPart::Length, given);
    return;
  }
  if (!guardTool(state, tool, given)) return;
  ir::Origin origin = given;
  origin.reason = "tool length that the source's macro corrects";
  const std::uint32_t error = state.helper();
  if (error == 0) return;
  writeWait(state, origin);
  assign(state, fmt::format("#{}", error), tidy(correction.error), origin);
  const ir::ExpressionPtr off = systemVariable(static_cast<int>(error));
  std::optional<Mark> within;
  if (correction.band != nullptr) {
    within = state.mark();
    jumpIf(state,
           ir::compare(ir::Relation::Less, ir::unary(ir::UnaryOp::Absolute, off), tidy(correction.band)),
           *within, origin);
  }
  const ir::ExpressionPtr entry = entryOf(*base, tool);
  const std::string left = machineText(state, entry, origin);
  assign(state, left,
         tidy(ir::binary(ir::BinaryOp::Subtract, ir::machineVariable(entry),
                         ir::binary(ir::BinaryOp::Multiply, tidy(correction.share), off))),
         origin);
  if (within) state.sheet.place(*within);
  state.releaseHelpers();
  if (state.reported.insert("corrects a tool").second)
    state.remarks.push_back("CORRECTS A TOOL LENGTH: GIVE G43 ANEW");
}

void writeReadTool(State& state, const std::string& left, ir::ToolPart part, const ir::ExpressionPtr& given,
                   const ir::Origin& origin) {
  const ir::ExpressionPtr tool = tidy(given);
  if (!hasPart(state, part, origin) || !guardTool(state, tool, origin)) return;
  const Registers at = registersOf(state.control, part);
  const auto entry = [&](int base) { return ir::machineVariable(entryOf(base, tool)); };
  if (isWear(part) || !at.hasWear())
    assign(state, left, entry(at.wear ? *at.wear : *at.geometry), origin);
  else
    assign(state, left, ir::binary(ir::BinaryOp::Add, entry(*at.geometry), entry(*at.wear)), origin);
  state.releaseHelpers();
  if (!isLength(part)) remarkRadius(state);
}

} // namespace dotek::backends::fanuc
