#include "backends/common/CycleTolerances.h"

#include "backends/common/MacroCall.h"
#include "ir/Fold.h"
#include "stdlib/MacroCycle.h"
#include "stdlib/RefusedLetters.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace dotek::backends {

namespace {

class Tolerances {
public:
  Tolerances(const stdlib::MacroSet& macros, const stdlib::MacroSignature& signature,
             const ExpectedAlong& expected)
      : macros_(macros), signature_(signature), expected_(expected) {}

  std::vector<Tolerance> take(ir::CallCycle& cycle) {
    const std::string letters = lettersOf(cycle);
    std::erase_if(cycle.arguments, [&](const ir::CycleArgument& one) {
      return !one.moves && !hasPlace(one, letters) && isTaken(cycle, one);
    });
    // A macro compares in its own order, whatever that of the letters is.
    std::stable_sort(checks_.begin(), checks_.end(),
                     [](const Ranked& a, const Ranked& b) { return a.rank < b.rank; });
    std::vector<Tolerance> out;
    for (Ranked& one : checks_)
      out.push_back(std::move(one.tolerance));
    return out;
  }

private:
  std::string lettersOf(const ir::CallCycle& cycle) const {
    std::string out;
    for (const ir::CycleArgument& one : cycle.arguments)
      if (const auto* place = macroArgument(signature_, one.parameter)) out += place->letter;
    for (const stdlib::MacroArgument& one : signature_.arguments)
      if (cycle.setting && one.role == stdlib::ArgumentRole::System) out += one.letter;
    return out;
  }
  // The macro takes it in a call of these letters.
  bool hasPlace(const ir::CycleArgument& one, const std::string& letters) const {
    const stdlib::MacroArgument* place = macroArgument(signature_, one.parameter);
    if (place == nullptr) return false;
    return stdlib::lettersRefused(macros_, signature_.program, letters, place->letter) == nullptr;
  }
  bool isTaken(const ir::CallCycle& cycle, const ir::CycleArgument& one) {
    constexpr stdlib::ArgumentRole kOrder[] = {
        stdlib::ArgumentRole::UpperLimit, stdlib::ArgumentRole::SizeTolerance,
        stdlib::ArgumentRole::PositionTolerance, stdlib::ArgumentRole::AngleTolerance};
    const auto* role = std::find_if(std::begin(kOrder), std::end(kOrder), [&](stdlib::ArgumentRole known) {
      return one.parameter == stdlib::roleName(known);
    });
    rank_ = static_cast<int>(role - std::begin(kOrder));
    if (one.parameter == stdlib::roleName(stdlib::ArgumentRole::UpperLimit))
      return addLimit(cycle, one.value);
    if (one.parameter == stdlib::roleName(stdlib::ArgumentRole::SizeTolerance))
      return add(sizeOf(cycle) != nullptr ? compared(sizeError(cycle)) : off(cycle), one.value,
                 "OUT OF TOLERANCE");
    if (one.parameter == stdlib::roleName(stdlib::ArgumentRole::PositionTolerance)) {
      const ir::ExpressionPtr error = off(cycle);
      return add(error == nullptr ? nullptr : ir::binary(ir::BinaryOp::Multiply, ir::constant(2), error),
                 one.value, "OUT OF POSITION");
    }
    if (one.parameter == stdlib::roleName(stdlib::ArgumentRole::AngleTolerance)) {
      const stdlib::MacroResult* angle = signature_.find(stdlib::Output::AngleError);
      return add(angle == nullptr ? nullptr : compared(variable(*angle)), one.value,
                 "ANGLE OUT OF TOLERANCE");
    }
    return false;
  }

  // Along each axis, and of the size. Of a feature without a size no source says whether a macro looks at
  // each axis or at the distance: the distance is never the smaller one.
  bool addLimit(const ir::CallCycle& cycle, const ir::ExpressionPtr& limit) {
    constexpr std::string_view kText = "UPPER LIMIT";
    if (!cycle.axis && sizeOf(cycle) == nullptr) return add(off(cycle), limit, kText);
    for (const ir::Axis axis : axesOf(cycle))
      if (!add(compared(errorAlong(cycle, axis)), limit, kText)) return false;
    const ir::ExpressionPtr size = sizeError(cycle);
    return size == nullptr || add(compared(size), limit, kText);
  }

  bool add(const ir::ExpressionPtr& error, const ir::ExpressionPtr& limit, std::string_view text) {
    if (error != nullptr) checks_.push_back({rank_, {error, compared(limit), text}});
    return error != nullptr;
  }
  static ir::ExpressionPtr variable(const stdlib::MacroResult& result) {
    return ir::machineVariable(ir::constant(static_cast<double>(result.variable)));
  }
  // Its size; null stays null.
  static ir::ExpressionPtr compared(const ir::ExpressionPtr& value) {
    if (value == nullptr) return nullptr;
    if (const double* known = ir::constantValue(value)) return ir::constant(std::abs(*known), value->range);
    return ir::unary(ir::UnaryOp::Absolute, value);
  }
  static std::vector<ir::Axis> axesOf(const ir::CallCycle& cycle) {
    if (cycle.axis) return {*cycle.axis};
    return {ir::Axis::X, ir::Axis::Y};
  }
  static const ir::CycleArgument* sizeOf(const ir::CallCycle& cycle) {
    const std::string width(stdlib::roleName(stdlib::ArgumentRole::Width));
    const std::string diameter(stdlib::roleName(stdlib::ArgumentRole::Diameter));
    for (const ir::CycleArgument& one : cycle.arguments)
      if (one.parameter == diameter || one.parameter.starts_with(width)) return &one;
    return nullptr;
  }

  ir::ExpressionPtr measured(stdlib::Output output) const {
    const stdlib::MacroResult* result = signature_.find(output);
    return result == nullptr || !result->documented ? nullptr : variable(*result);
  }
  ir::ExpressionPtr sizeError(const ir::CallCycle& cycle) const {
    const ir::CycleArgument* size = sizeOf(cycle);
    const ir::ExpressionPtr found = size == nullptr ? nullptr : measured(stdlib::Output::Size);
    return found == nullptr ? nullptr : ir::binary(ir::BinaryOp::Subtract, found, size->value);
  }
  ir::ExpressionPtr errorAlong(const ir::CallCycle& cycle, ir::Axis axis) {
    constexpr stdlib::Output kPositions[] = {stdlib::Output::PositionX, stdlib::Output::PositionY,
                                             stdlib::Output::PositionZ};
    const ir::ExpressionPtr found = measured(kPositions[ir::indexOf(axis)]);
    const ir::ExpressionPtr wanted = found == nullptr ? nullptr : expected_(cycle, axis);
    return wanted == nullptr ? nullptr : ir::binary(ir::BinaryOp::Subtract, found, wanted);
  }
  // How far the feature lies from where it is expected.
  ir::ExpressionPtr off(const ir::CallCycle& cycle) {
    ir::ExpressionPtr out;
    for (const ir::Axis axis : axesOf(cycle)) {
      const ir::ExpressionPtr error = errorAlong(cycle, axis);
      if (error == nullptr) return nullptr;
      if (cycle.axis) return compared(error);
      const ir::ExpressionPtr square = ir::binary(ir::BinaryOp::Multiply, error, error);
      out = out == nullptr ? square : ir::binary(ir::BinaryOp::Add, out, square);
    }
    return ir::unary(ir::UnaryOp::SquareRoot, out);
  }

  const stdlib::MacroSet& macros_;
  const stdlib::MacroSignature& signature_;
  const ExpectedAlong& expected_;
  struct Ranked {
    int rank = 0;
    Tolerance tolerance;
  };
  int rank_ = 0; // of the argument that is looked at
  std::vector<Ranked> checks_;
};

} // namespace

std::vector<Tolerance> takeTolerances(ir::CallCycle& cycle, const stdlib::MacroSet& macros,
                                      const stdlib::MacroSignature& signature,
                                      const ExpectedAlong& expected) {
  return Tolerances(macros, signature, expected).take(cycle);
}

} // namespace dotek::backends
