// Calls of a vendor's probing macros as back ends write them: which signature says a statement, what each of
// its arguments is, and which variable holds a result afterwards.
#pragma once

#include "ir/Cycle.h"
#include "ir/Statement.h"
#include "stdlib/MacroCycle.h"
#include "stdlib/MacroSet.h"
#include "support/messages/Fanuc.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::backends {

// The signature that measures so; nullptr: the set has none.
const stdlib::MacroSignature* signatureOf(const stdlib::MacroSet& macros, const ir::Measure& measure);
// Of a cycle: the one that takes most of its parameters; nullptr: the set has none of its name and axis.
const stdlib::MacroSignature* signatureOf(const stdlib::MacroSet& macros, const ir::CallCycle& cycle);
// Of a Measure or a CallCycle; nullptr for any other statement, too.
const stdlib::MacroSignature* signatureOf(const stdlib::MacroSet& macros,
                                          const ir::CycleStatement& statement);
// The argument of the macro that the parameter of a cycle fills; nullptr: none.
const stdlib::MacroArgument* macroArgument(const stdlib::MacroSignature& signature,
                                           const std::string& parameter);
// "a three-point bore", "a web along X"
std::string featureName(const ir::CallCycle& cycle);
// What no source says of the cycle, where `macros` is not the set of its source: "the path round the corner";
// "": the same set, or all is known.
std::string openMeaning(const stdlib::MacroSignature& signature, const ir::CallCycle& cycle,
                        const stdlib::MacroSet& macros);
// "a bore", "a surface along X"
std::string featureName(const ir::Measure& measure);
// The axes along which the measurement finds a coordinate.
std::vector<ir::Axis> measuredAxes(const ir::Measure& measure);
// It sets the offset of an axis along which it finds none.
bool setsAnotherAxis(const ir::Measure& measure);

// What a back end knows beside the statement.
struct CallValues {
  // `coordinate` along the axis, counted from the frame; nullptr: refused. Never empty.
  std::function<ir::ExpressionPtr(const ir::Coordinate& coordinate, ir::Axis axis, ir::Frame frame)> place;
  // The greatest travel beyond what is expected; nullptr or empty: the macro's own.
  std::function<ir::ExpressionPtr()> overtravel;
  // How far the source searches beyond what it expects along the axis where the statement does not say;
  // nullptr or empty: not known. A macro that takes a travel and no overtravel travels that much farther.
  std::function<ir::ExpressionPtr(ir::Axis axis)> beyond = {};
  // A travel of the source leads to where the surface is expected, as its places do.
  bool travelsToSurface = false;
  bool setsSystem = true;           // the call itself sets the offset of the measurement
  const ir::Cycle* cycle = nullptr; // whose locals the arguments name; nullptr: they are what they are
};

// How far from the probe the source expects the surface that a call touches along a direction of the plane
// XY, mm along the axis; nullptr: another cycle.
ir::ExpressionPtr awayAlong(const ir::CallCycle& cycle, ir::Axis axis);
// Where the probe is and how far from it; a null pointer of either is left out.
ir::ExpressionPtr awayFrom(const ir::ExpressionPtr& position, const ir::CallCycle& cycle, ir::Axis axis);

// Overtravel of calls that state none; nullptr: not known, or there is no set.
ir::ExpressionPtr overtravelOf(const stdlib::MacroSet* macros, ir::Axis axis);

// How far the macro that `signature` describes, of `macros`, searches beyond the end of a travel that is all
// that is known of the search of the source's own macro, of `source`, mm; nothing: no farther, or not known.
std::optional<double> searchesOn(const stdlib::MacroSet* source, const stdlib::MacroSet& macros,
                                 const stdlib::MacroSignature& signature, const ir::Measure& measure);

// Known to be 0: it says no direction.
bool isNoTravel(const ir::ExpressionPtr& travel);
// `travel`, made longer by `more` in its own direction, where it has one.
ir::ExpressionPtr longerTravel(const ir::ExpressionPtr& travel, const ir::ExpressionPtr& more);

struct GivenArgument {
  const stdlib::MacroArgument* argument = nullptr; // never null
  ir::ExpressionPtr value;                         // never null
};

struct MacroCall {
  const stdlib::MacroSignature* signature = nullptr;
  std::vector<GivenArgument> arguments;                   // in the order of the signature
  std::vector<const stdlib::MacroArgument*> missing = {}; // required, and the statement states no value
  std::vector<std::string> notTaken = {};                 // parameters that the macro has no letter for
  bool hasNoWay = false;      // the surface is expected where the probe is: which way it lies is not known
  bool endsAtSurface = false; // it searches no farther than to where the surface is expected
  const stdlib::MacroArgument* notAbove = nullptr; // it takes values above 0, and this one never is
};

// "`R` of P8812 below 0, which is an island"; "": it takes what it is given.
std::string refusedSign(const MacroCall& call);

// What of MacroCall::hasNoWay a set has no call for.
inline constexpr std::string_view kNoWay = "a surface where the probe is, as a travel of 0 has no direction";

MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::Measure& measure,
                    const CallValues& values);
// Of a cycle by its name and its parameters. A nominal that the macro wants is `setting`'s.
MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::CallCycle& cycle,
                    const CallValues& values);
// Of a protected move.
MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::Move& move, const CallValues& values);
// An axis that the move names and the protected move of the set does not take; nothing: it takes all.
std::optional<ir::Axis> axisNotTaken(const stdlib::MacroSignature& signature, const ir::Move& move);

// "`S` and `H` of P9811 together": letters of the call that the macro refuses together; "": none.
std::string refusedTogether(const stdlib::MacroSet& macros, const MacroCall& call);

// Reports the first argument that the call lacks, that it has no way, a sign that it does not take, or
// letters that exclude each other. `state` has refuse<Id>(range, arguments...).
template <class State>
void refuseMissing(State& state, const stdlib::MacroSet& macros, const MacroCall& call, SourceRange range) {
  if (call.hasNoWay) state.template refuse<diag::MacroSetCannot>(range, macros.title, kNoWay);
  if (const std::string sign = refusedSign(call); !sign.empty())
    state.template refuse<diag::MacroSetCannot>(range, macros.title, sign);
  if (const std::string together = refusedTogether(macros, call); !together.empty())
    state.template refuse<diag::MacroSetCannot>(range, macros.title, together);
  if (call.missing.empty()) return;
  const stdlib::MacroArgument& argument = *call.missing.front();
  const std::string letter(1, argument.letter);
  if (argument.role == stdlib::ArgumentRole::System || argument.role == stdlib::ArgumentRole::Nominal)
    state.template refuse<diag::NeedsOffset>(range, macros.title, letter);
  else
    state.template refuse<diag::MacroArgumentMissing>(range, call.signature->program, letter);
}

const stdlib::MacroResult* findResult(const stdlib::MacroSignature& signature, ir::ResultName name);

struct FoundResult {
  const stdlib::MacroResult* result = nullptr; // nullptr: the set has none
  // What it is, where the set has no "the result" and the measurement's own stands for it.
  std::optional<ir::ResultName> instead;
};
FoundResult resultAfter(const stdlib::MacroSignature& signature, const ir::Measure& measure,
                        ir::ResultName name);
FoundResult resultAfter(const stdlib::MacroSignature& signature, const ir::CycleStatement& measured,
                        ir::ResultName name);

// A move, a measurement, or a call that is one of the two.
bool movesProbe(const ir::CycleStatement& statement);

// The cycle moves or measures by macros of a set, beside switching the probe: what another set has in their
// place needs position and modes.
bool callsMacros(const ir::Cycle& cycle);

} // namespace dotek::backends
