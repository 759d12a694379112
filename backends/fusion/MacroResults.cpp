// Results of measurements in blocks for another macro set: copied, or computed from what its macros leave.
#include "backends/common/MacroCall.h"
#include "backends/fusion/State.h"
#include "ir/Fold.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

namespace dotek::backends::fusion {

bool MacroBlocks::errorText(ir::ResultName name, const stdlib::MacroSignature& signature,
                            const ir::Origin& origin, Text& text) {
  ir::ResultName measured = ir::ResultName::Size;
  ir::ExpressionPtr expected;
  switch (name) {
  case ir::ResultName::ErrorX: measured = ir::ResultName::PositionX; break;
  case ir::ResultName::ErrorY: measured = ir::ResultName::PositionY; break;
  case ir::ResultName::ErrorZ: measured = ir::ResultName::PositionZ; break;
  case ir::ResultName::SizeError: break;
  default: return false;
  }
  if (name == ir::ResultName::SizeError) {
    const auto* cycle = std::get_if<ir::CallCycle>(&last_->node);
    const auto* measure = std::get_if<ir::Measure>(&last_->node);
    if (measure != nullptr) expected = measure->diameter;
    for (std::size_t i = 0; cycle != nullptr && i < cycle->arguments.size(); ++i)
      if (const ir::CycleArgument& one = cycle->arguments[i];
          one.parameter == stdlib::roleName(stdlib::ArgumentRole::Diameter) ||
          one.parameter.starts_with(stdlib::roleName(stdlib::ArgumentRole::Width)))
        expected = one.value;
  } else {
    expected =
        expected_[static_cast<std::size_t>(measured) - static_cast<std::size_t>(ir::ResultName::PositionX)]
            .value;
  }
  const stdlib::MacroResult* found = findResult(signature, measured);
  if (found == nullptr || !found->documented || expected == nullptr) return false;
  text.add("#" + std::to_string(found->variable) + "-[");
  texts_.number(text, expected, origin);
  text.add("]");
  return true;
}

void MacroBlocks::store(const ir::Store& store, const ir::Origin& origin, std::vector<Text>& lines) {
  const auto* result = std::get_if<ir::MeasuredResult>(&store.value->node);
  const double* number = ir::constantValue(store.number);
  if (result == nullptr || number == nullptr) {
    Text text;
    macro(text, ir::machineVariable(store.number), origin);
    text.add("=");
    wholeRound_ = true;
    macro(text, ir::simplify(store.value), origin);
    wholeRound_ = false;
    lines.push_back(std::move(text));
    return;
  }
  const stdlib::MacroSignature* signature =
      last_ == nullptr ? nullptr : signatureOf(state_.options.macros, *last_);
  const FoundResult known =
      signature == nullptr ? FoundResult() : resultAfter(*signature, *last_, result->name);
  const stdlib::MacroResult* found = known.result;
  if (known.instead)
    state_.diagnostics.report<diag::ResultDiffers>(
        store.value->range, found->variable, state_.options.macros.title, ir::resultTitle(*known.instead));
  if (found == nullptr) {
    if (state_.failed) return; // the measurement was refused
    Text computed;
    computed.add("#" + numberText(*number) + "=");
    if (signature != nullptr && errorText(result->name, *signature, origin, computed)) {
      lines.push_back(std::move(computed));
      return;
    }
    state_.refuse<diag::ResultUnknown>(origin.range(), state_.options.macros.title,
                                       ir::resultTitle(result->name));
    return;
  }
  Text text;
  text.add("#" + numberText(*number) + "=#" + std::to_string(found->variable));
  lines.push_back(std::move(text));
}

} // namespace dotek::backends::fusion
