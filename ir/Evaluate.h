// Values of expressions and conditions: the one evaluator behind folding, checks and (later) simulation.
#pragma once

#include "ir/Arithmetic.h"
#include "ir/Cycle.h"

#include <functional>
#include <optional>
#include <vector>

namespace dotek::ir {

// Null is std::nullopt inside; Unknown says that the value is not given.
struct Scalar {
  enum class State : std::uint8_t { Known, Null, Unknown, Failed };
  State state = State::Unknown;
  double value = 0;
  ArithmeticError error = ArithmeticError::None; // of Failed
  bool known() const { return state == State::Known; }
};

// By VariableId; shorter than the cycle's variables: the rest is unknown.
using Environment = std::vector<Scalar>;

// Machine variables and measured results are unknown.
Scalar evaluate(const Expression& expression, const Environment& environment);
// nullopt: it hangs on something unknown or failed.
std::optional<bool> holds(const Condition& condition, const Environment& environment);

// How the checks end for the values.
struct CheckRun {
  enum class End : std::uint8_t { Passes, Alarm, Unknown, Failed, Endless };
  End end = End::Passes;
  const Statement* at = nullptr; // the alarm, or what could not be decided
};
CheckRun runChecks(const Cycle& cycle, Environment environment, std::uint32_t maxSteps);

} // namespace dotek::ir
