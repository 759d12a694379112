// The functions of the macro language.
#pragma once

#include "frontend/gibbs/Value.h"
#include "ir/Arithmetic.h"
#include "ir/Expression.h"

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace dotek::frontend::gibbs {

// What the operator is in the IR.
ir::BinaryOp irOperator(BinaryOperator op);

// A function of numbers.
struct NumberFunction {
  enum class Angle : std::uint8_t { None, Argument, Result };
  using Op = std::variant<ir::UnaryOp, ir::BinaryOp>;

  std::string_view name;
  Op op;                     // what it is in the IR, angles in degrees
  Angle angle = Angle::None; // what counts in the unit of angles
  bool mayFail = false;
  ir::Computed (*compute)(double a, double b, ir::AngleUnit unit); // of one number: `b` is not read

  std::size_t arity() const { return op.index() + 1; }
};

// nullptr: no such function. `name` is folded.
extern const NumberFunction kNegation;
const NumberFunction* numberFunction(std::string_view name);

// A function of texts, or one that gives a text. Neither value nor error: `name` is none, or an argument is
// not known.
struct TextResult {
  std::optional<Value> value;
  std::string_view error; // what has no result, for messages
};
TextResult textFunction(std::string_view name, const std::vector<Value>& arguments);

} // namespace dotek::frontend::gibbs
