// What the parts of the back end share while they write one cycle.
#pragma once

#include "backends/cycle/Emit.h"
#include "ir/Kind.h"
#include "support/messages/Cycle.h"

#include <array>
#include <unordered_map>

namespace dotek::backends::cycle {

// A condition that has to hold before anything moves, and the message where it does not.
struct Requirement {
  ir::ConditionPtr condition;
  const ir::CycleStatement* alarm = nullptr; // never a null pointer
  SourceRange range;
};

struct State {
  State(const ir::Cycle& cycleOf, const EmitOptions& optionsOf, Diagnostics& report)
      : cycle(cycleOf), options(optionsOf), diagnostics(report) {}

  // Has no form in the language.
  void refuse(SourceRange range, const std::string& what, const std::string& remedy) {
    failed = true;
    diagnostics.report<diag::CycleFormCannot>(range, what, remedy);
  }
  // Something of the source that is not in the cycle, once for each `what`.
  void note(SourceRange range, const std::string& what, const std::string& why) {
    if (noted.insert(what).second) diagnostics.report<diag::CycleFormLeftOut>(range, what, why);
  }
  void add(std::string text, const ir::Origin& origin, std::string reason = "") {
    lines.push_back({std::move(text), origin.ranges, std::move(reason)});
  }
  // A name that nothing in the cycle has yet: "surface", "surface_2".
  std::string fresh(const std::string& base);

  ir::Cycle cycle; // a copy: kinds are added
  const EmitOptions& options;
  Diagnostics& diagnostics;
  bool failed = false;
  std::set<std::string> noted;

  std::set<std::string> taken;                 // names
  std::map<std::string, int> nextOf;           // the number that fresh() tries next, by the name
  std::map<ir::VariableId, std::string> names; // of all variables that are read
  std::map<ir::VariableId, double> shifts;     // of work offsets
  // Of parameters that are a choice of names: the names, of 1, 2, ..
  std::map<ir::VariableId, std::vector<std::string>> choices;
  std::set<ir::VariableId> aliases; // names that may repeat what a touch gives
  // Where the probe is along each axis, as the moves say it; "": they do not.
  std::array<std::string, 3> at;
  // What the results of the last measurement are in the cycle.
  std::map<ir::ResultName, std::string> measured;
  bool joined = false;                       // ways have met, after which what was measured last is not known
  std::map<std::uint32_t, std::string> kept; // results by the variable of the source
  std::vector<std::pair<std::string, ir::Kind>> results;   // in their order
  std::map<std::string, std::string> resultTitles;         // by name
  std::map<std::pair<int, double>, std::string> constants; // named numbers, by kind
  std::vector<EmittedLine> named;                          // their lines
  std::vector<EmittedLine> lines;                          // the part that is being written
  std::vector<std::string> helpers; // names that a line gives a value to in case something reads it
};

// ---- Names.cpp

// Names, kinds and shifts of all parameters, hosts and locals.
void nameVariables(State& state);

// ---- Choices.cpp

// Parameters whose dialog lists 1, 2, .. and that are only compared with these are a choice of names, and
// those that list yes and no are flags.
void findChoices(State& state);
// "\"Nominal diameter\"", "" for none.
std::string quoted(std::string_view text);
std::string typeOf(ir::Kind kind); // "length"

// ---- Expressions.cpp

// The value as the language writes it; constants get the unit of their kind. `want`: the kind of the place.
// "": refused.
std::string valueText(State& state, const ir::ExpressionPtr& value, ir::Kind want, SourceRange range);
std::string conditionText(State& state, const ir::ConditionPtr& condition, SourceRange range);
std::string literal(double value, ir::Kind kind, const std::string& digits = "");
ir::Kind kindOf(const State& state, const ir::ExpressionPtr& value);
// Without the operators around it that make 0 of null.
const ir::Expression& bare(const ir::ExpressionPtr& value);
// A product of two lengths, which has no kind of its own.
bool isArea(const State& state, const ir::ExpressionPtr& value);
// A work offset: "G56", or the parameter. "": refused.
std::string systemText(State& state, const ir::ExpressionPtr& system, SourceRange range);

// ---- Checks.cpp

struct Checked {
  std::vector<Requirement> requirements;
  std::map<ir::VariableId, ir::ExpressionPtr> locals; // what the checks leave for the body
};
// nullopt: refused.
std::optional<Checked> readChecks(State& state);

// ---- Systems.cpp

// A work offset that the checks count from a parameter (`index = wcs - 53`, set as `index + 53`) is that
// parameter.
void nameSystems(State& state, const Checked& checked);

// ---- Body.cpp

void writeBody(State& state);

// ---- Results.cpp

// A variable that the source leaves is a result of the cycle.
void writeResult(State& state, const ir::Store& node, const ir::Origin& origin);

// ---- Measures.cpp

// Where the probe is, or "here.x".
std::string hereText(const State& state, ir::Axis axis);
void writeMeasure(State& state, const ir::Measure& measure, const ir::Origin& origin);
void writeCall(State& state, const ir::CallCycle& call, const ir::Origin& origin);

// ---- Places.cpp

// "x 5 mm" as part of a move to coordinates. "": refused.
std::string placeText(State& state, const ir::Coordinate& coordinate, ir::Axis axis, SourceRange range);
// The coordinate in the active work offset: "start.x + 5 mm". "": refused.
std::string workText(State& state, const ir::Coordinate& coordinate, ir::Axis axis, SourceRange range);

} // namespace dotek::backends::cycle
