// Values of expressions and conditions: the one evaluator after folding, checks and simulation.
#pragma once

#include "ir/Arithmetic.h"
#include "ir/Cycle.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dotek::ir {

// Unknown says that the value is not given.
struct Scalar {
  enum class State : std::uint8_t { Known, Null, Unknown, Failed };
  State state = State::Unknown;
  double value = 0;
  ArithmeticError error = ArithmeticError::None; // of Failed
  bool known() const { return state == State::Known; }

  static Scalar of(double number) { return {State::Known, number, ArithmeticError::None}; }
  static Scalar null() { return {State::Null, 0, ArithmeticError::None}; }
  static Scalar failed(ArithmeticError why) { return {State::Failed, 0, why}; }
};

// By VariableId; shorter than the cycle's variables: the rest is unknown.
using Environment = std::vector<Scalar>;

// What the operator gives for numbers, angles in degrees. What a number cannot tell fails (Domain): rounding
// to the increment of a word, the point that ADP adds. NullAsZero and ValueOr give `a`.
Computed compute(UnaryOp op, double a);
Computed compute(BinaryOp op, double a, double b);

// What a run has beside the variables of the cycle.
class Readings {
public:
  virtual ~Readings() = default;
  virtual Scalar result(ResultName name) const = 0; // of the last measurement
  virtual Scalar machineVariable(double number) const = 0;
};

// Without `readings` machine variables and measured results are unknown. Null in arithmetic fails (NoValue);
// what fails outweighs what is unknown.
Scalar evaluate(const Expression& expression, const Environment& environment,
                const Readings* readings = nullptr);
// Unknown outweighs Failed: the unknown side may still decide.
enum class Verdict : std::uint8_t { False, True, Unknown, Failed };
Verdict decide(const Condition& condition, const Environment& environment,
               const Readings* readings = nullptr);
// A side that is known decides AND and OR, whatever the other one is. nullopt: it depends on something
// unknown or failed; Null in a comparison fails.
std::optional<bool> holds(const Condition& condition, const Environment& environment);

// How the checks end for the values. Unknown: at a branch that depends on an unknown value, or at a block
// whose meaning is not known. Failed: at a branch or an assignment whose arithmetic fails. Endless: more than
// `maxSteps` statements.
struct CheckRun {
  enum class End : std::uint8_t { Passes, Alarm, Unknown, Failed, Endless };
  End end = End::Passes;
  const CycleStatement* at = nullptr; // in cycle.checks: the alarm, or what could not be decided
};
CheckRun runChecks(const Cycle& cycle, Environment environment, std::uint32_t maxSteps);

} // namespace dotek::ir
