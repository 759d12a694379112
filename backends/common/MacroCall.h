// Calls of a vendor's probing macros as back ends write them: which signature says a statement, what each of
// its arguments is, and which variable holds a result afterwards.
#pragma once

#include "ir/Statement.h"
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
  bool setsSystem = true; // the call itself sets the offset of the measurement
};

struct GivenArgument {
  const stdlib::MacroArgument* argument = nullptr; // never null
  ir::ExpressionPtr value;                         // never null
};

struct MacroCall {
  const stdlib::MacroSignature* signature = nullptr;
  std::vector<GivenArgument> arguments;              // in the order of the signature
  std::vector<const stdlib::MacroArgument*> missing; // required, and the statement states no value
};

MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::Measure& measure,
                    const CallValues& values);
// Of a protected move.
MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::Move& move, const CallValues& values);
// An axis that the move names and the protected move of the set does not take; nothing: it takes all.
std::optional<ir::Axis> axisNotTaken(const stdlib::MacroSignature& signature, const ir::Move& move);

// Reports the first argument that the call lacks. `state` has refuse<Id>(range, arguments...).
template <class State>
void refuseMissing(State& state, const stdlib::MacroSet& macros, const MacroCall& call, SourceRange range) {
  if (call.missing.empty()) return;
  const stdlib::MacroArgument& argument = *call.missing.front();
  const std::string letter(1, argument.letter);
  if (argument.role == stdlib::ArgumentRole::System || argument.role == stdlib::ArgumentRole::Nominal)
    state.template refuse<diag::NeedsOffset>(range, macros.title, letter);
  else
    state.template refuse<diag::MacroArgumentMissing>(range, call.signature->program, letter);
}

// "the result", "the position in X"
std::string_view resultName(ir::ResultName name);
const stdlib::MacroResult* findResult(const stdlib::MacroSignature& signature, ir::ResultName name);

struct FoundResult {
  const stdlib::MacroResult* result = nullptr; // nullptr: the set has none
  // What it is, where the set has no "the result" and the measurement's own stands for it.
  std::optional<ir::ResultName> instead;
};
FoundResult resultAfter(const stdlib::MacroSignature& signature, const ir::Measure& measure,
                        ir::ResultName name);

} // namespace dotek::backends
