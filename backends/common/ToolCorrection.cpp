#include "backends/common/ToolCorrection.h"

#include <algorithm>
#include <string>

namespace dotek::backends {

using stdlib::ArgumentRole;

std::optional<ToolCorrection> takeToolCorrection(ir::CallCycle& cycle, const stdlib::MacroSet* source,
                                                 const stdlib::MacroSignature& signature,
                                                 const ExpectedAlong& expected) {
  using Register = stdlib::ProbingFacts::ToolRegister;
  const auto valueOf = [&](ArgumentRole role) -> ir::ExpressionPtr {
    for (const ir::CycleArgument& one : cycle.arguments)
      if (one.parameter == stdlib::roleName(role)) return one.value;
    return nullptr;
  };
  ToolCorrection out;
  out.tool = valueOf(ArgumentRole::Tool);
  out.share = valueOf(ArgumentRole::Feedback);
  out.band = valueOf(ArgumentRole::NullBand);
  const double* share = out.share == nullptr ? nullptr : ir::constantValue(out.share);
  const stdlib::MacroResult* found = signature.find(stdlib::Output::PositionZ);
  if (out.tool == nullptr || out.share == nullptr || (share != nullptr && !(*share >= 0 && *share <= 1)) ||
      source == nullptr || source->probing.toolLength == Register::Unknown || cycle.axis != ir::Axis::Z ||
      signature.intent != stdlib::Intent::Surface || signature.find(ArgumentRole::Tool) != nullptr ||
      found == nullptr || !found->documented)
    return std::nullopt;
  const ir::ExpressionPtr wanted = expected(cycle, ir::Axis::Z);
  if (wanted == nullptr) return std::nullopt;
  const auto variable = ir::machineVariable(ir::constant(static_cast<double>(found->variable)));
  out.error = ir::binary(ir::BinaryOp::Subtract, variable, wanted);
  out.geometry = source->probing.toolLength == Register::Geometry;
  std::erase_if(cycle.arguments, [](const ir::CycleArgument& one) {
    const auto is = [&](ArgumentRole role) { return one.parameter == stdlib::roleName(role); };
    return is(ArgumentRole::Tool) || is(ArgumentRole::Feedback) || is(ArgumentRole::NullBand);
  });
  return out;
}

} // namespace dotek::backends
