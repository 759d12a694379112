// Expressions and conditions of the IR. Nodes are immutable and shared: substitution copies pointers.
// Lengths are mm, angles degrees, feeds mm/min.
#pragma once

#include "ir/Kind.h"
#include "support/Source.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

namespace dotek::ir {

struct Expression;
using ExpressionPtr = std::shared_ptr<const Expression>; // never null unless a member says so

using VariableId = std::uint32_t; // index in Cycle::variables
using LabelId = std::uint32_t;    // index in Cycle::labels

struct Constant {
  double value = 0;   // finite
  std::string digits; // as the source writes it, sign included; "" where it was computed
};
// The value of a variable that is not set (Macro B #0). Only in Assign, ValueOr and as a word's value.
struct NullValue {};
struct VariableUse {
  VariableId variable = 0;
};
// A variable of the machine, by number: #550. Kind Number.
struct MachineVariable {
  ExpressionPtr number;
};
// What the last measurement that was carried out left. `Documented` ones are defined by the macro set;
// Main is "the result" of a set that does not say what it holds (EasyProbe #138).
// X(id, text form, as messages name it)
#define DOTEK_RESULTS(X)                                                                                     \
  X(Main, "main", "the result")                                                                              \
  X(PositionX, "x", "the position in X")                                                                     \
  X(PositionY, "y", "the position in Y")                                                                     \
  X(PositionZ, "z", "the position in Z")                                                                     \
  X(Size, "size", "the size")                                                                                \
  X(Angle, "angle", "the angle")                                                                             \
  X(AngleY, "angle-y", "the angle of the Y face")                                                            \
  X(ErrorX, "error-x", "the error in X")                                                                     \
  X(ErrorY, "error-y", "the error in Y")                                                                     \
  X(ErrorZ, "error-z", "the error in Z")                                                                     \
  X(SizeError, "size-error", "the error of the size")                                                        \
  X(AngleError, "angle-error", "the error of the angle")                                                     \
  X(AngleErrorY, "angle-error-y", "the error of the angle of the Y face")                                    \
  X(TruePosition, "true-position", "the true position")                                                      \
  X(MetalCondition, "metal-condition", "the metal condition")                                                \
  X(TouchDirection, "direction", "the direction of the touch")                                               \
  X(Hole, "hole", "the number of the hole")                                                                  \
  X(Maximum, "maximum", "the greatest value")                                                                \
  X(Variation, "variation", "the variation")                                                                 \
  X(OutOfTolerance, "out-of-tolerance", "the flag of the tolerances")                                        \
  X(ProbeError, "probe-error", "the flag of the probe")
enum class ResultName : std::uint8_t {
#define DOTEK_RESULT(id, text, title) id,
  DOTEK_RESULTS(DOTEK_RESULT)
#undef DOTEK_RESULT
};
std::string_view resultText(ResultName name);  // "x"
std::string_view resultTitle(ResultName name); // "the position in X"
struct MeasuredResult {
  ResultName name = ResultName::Main;
};

enum class UnaryOp : std::uint8_t {
  Negate,
  Absolute,
  Truncate, // toward zero (Macro B FIX, GibbsCAM INT)
  RoundUp,  // away from zero (FUP)
  Round,    // to the nearest integer, half away from zero
  SquareRoot,
  Sine, // angles in degrees, as for all below
  Cosine,
  Tangent,
  ArcSine,
  ArcCosine,
  ArcTangent, // -90 to 90
  Logarithm,
  Exponential,
  NullAsZero, // null becomes 0; anything else stays
  // Of macro programs:
  RoundIncrement, // ROUND after an address: to the least input increment of the word that holds it
  FromBcd,        // BIN: the decimal digits of a number in BCD
  ToBcd,          // BCD
  AddPoint,       // ADP: an argument that was passed without a point gets it
};
enum class BinaryOp : std::uint8_t {
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Direction, // angle of (x = left, y = right), above -180 up to 180
  BitAnd,
  BitOr,
  BitXor,
  ValueOr, // left, or right where left is null
  // Of macro programs; the first four round both operands to whole numbers, half away from zero:
  RoundedAnd,
  RoundedOr,
  RoundedXor,
  RoundedModulo, // sign of the dividend
  Power,
  Bearing, // as Direction, from 0 up to below 360
};
// The last ones, for who goes through all of them.
inline constexpr UnaryOp kLastUnaryOp = UnaryOp::AddPoint;
inline constexpr BinaryOp kLastBinaryOp = BinaryOp::Bearing;
struct Unary {
  UnaryOp op = UnaryOp::Negate;
  ExpressionPtr operand;
};
struct Binary {
  BinaryOp op = BinaryOp::Add;
  ExpressionPtr left, right;
};

struct Expression {
  SourceRange range; // no place where it was made up
  std::variant<Constant, NullValue, VariableUse, MachineVariable, MeasuredResult, Unary, Binary> node;
};

// -0 becomes 0.
ExpressionPtr constant(double value, SourceRange range = {}, std::string digits = "");
// The number where the source writes one without a decimal point; nullptr: it has one, or something else.
const Constant* numberWithoutPoint(const ExpressionPtr& value);
ExpressionPtr nullValue(SourceRange range = {});
ExpressionPtr variable(VariableId id, SourceRange range = {});
ExpressionPtr machineVariable(ExpressionPtr number, SourceRange range = {});
ExpressionPtr result(ResultName name, SourceRange range = {});
ExpressionPtr unary(UnaryOp op, ExpressionPtr operand, SourceRange range = {});
ExpressionPtr binary(BinaryOp op, ExpressionPtr left, ExpressionPtr right, SourceRange range = {});
// The constant's value; nullptr for any other node.
const double* constantValue(const ExpressionPtr& expression);
// Same tree, ranges and digits aside. Null pointers are equal to each other alone.
bool equal(const ExpressionPtr& a, const ExpressionPtr& b);

// ---- conditions -------------------------------------------------------------------------------------------

struct Condition;
using ConditionPtr = std::shared_ptr<const Condition>;

// Same, Different: of macro programs; null is a value of its own, equal to null alone.
enum class Relation : std::uint8_t {
  Equal,
  NotEqual,
  Less,
  Greater,
  LessEqual,
  GreaterEqual,
  Same,
  Different
};
inline constexpr Relation kLastRelation = Relation::Different;
// Equal with NotEqual, Less with GreaterEqual, Greater with LessEqual, Same with Different: exact, as no
// value is a NaN.
Relation opposite(Relation relation);

struct Comparison {
  Relation relation = Relation::Equal;
  ExpressionPtr left, right; // neither is null at run time, but of Same and Different
};
struct IsNull {
  ExpressionPtr value;
};
struct Not {
  ConditionPtr inner;
};
enum class Connective : std::uint8_t { And, Or };
struct Junction {
  Connective op = Connective::And;
  ConditionPtr left, right;
};
struct Truth {
  bool value = true;
};

struct Condition {
  SourceRange range;
  std::variant<Comparison, IsNull, Not, Junction, Truth> node;
};

ConditionPtr compare(Relation relation, ExpressionPtr left, ExpressionPtr right, SourceRange range = {});
ConditionPtr isNull(ExpressionPtr value, SourceRange range = {});
// Pushes the negation inward: no Not in the result except around IsNull.
ConditionPtr negate(const ConditionPtr& condition);
ConditionPtr join(Connective op, ConditionPtr left, ConditionPtr right, SourceRange range = {});
ConditionPtr truth(bool value, SourceRange range = {});
// Same tree, ranges and digits aside.
bool equal(const ConditionPtr& a, const ConditionPtr& b);

} // namespace dotek::ir
