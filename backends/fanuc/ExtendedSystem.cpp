// Work systems beyond G59: G54.1 P1 of one control is G154 P1 of another (haas.md, 7) in copied blocks, and
// another number in a call.
#include "backends/fanuc/State.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dotek::backends::fanuc {

namespace {

const ir::Word* find(const ir::OpaqueBlock& block, char address) {
  const auto at = std::find_if(block.words.begin(), block.words.end(),
                               [&](const ir::Word& word) { return word.address == address; });
  return at == block.words.end() ? nullptr : &*at;
}

bool isCode(const ir::Word& word, const stdlib::CodeInfo& code) {
  const double* number = word.value == nullptr ? nullptr : ir::constantValue(word.value);
  return number != nullptr && word.address == code.letter &&
         std::round(*number * 10) == static_cast<double>(code.tenths);
}

} // namespace

void translateExtendedSystem(State& state) {
  const stdlib::Control& from = state.options.sourceControl;
  const stdlib::CodeInfo* const here = from.find(stdlib::Function::ExtendedWorkSystem);
  const stdlib::CodeInfo* const there = state.control.find(stdlib::Function::ExtendedWorkSystem);
  if (here == nullptr || there == nullptr) return;
  if (here->letter == there->letter && here->tenths == there->tenths) return;
  // Both have at least those whose offsets variables hold.
  const int most = std::min(from.variables.extendedCount, state.control.variables.extendedCount);
  std::vector<ir::Word*> found;
  for (auto* list : {&state.cycle.checks, &state.cycle.body})
    for (ir::CycleStatement& statement : *list) {
      auto* const block = std::get_if<ir::OpaqueBlock>(&statement.node);
      if (block == nullptr) continue;
      for (ir::Word& word : block->words) {
        if (isCode(word, *there)) return; // the source has it for something else
        const ir::Word* const which = find(*block, 'P');
        if (!isCode(word, *here) || which == nullptr || which->value == nullptr) continue;
        const double* const number = ir::constantValue(which->value);
        if (number != nullptr ? *number >= 1 && *number <= most : confinedTo(state, which->value, 1, most))
          found.push_back(&word);
      }
    }
  for (ir::Word* const word : found)
    word->value = ir::constant(there->tenths / 10.0, word->value->range, numberText(there->tenths / 10.0));
  state.extendedTranslated = !found.empty();
}

namespace {

constexpr double kFirstSystem = 54, kLastSystem = 59;

// As the calls of the source name them.
const stdlib::MacroArgument* namedBySource(const State& state, const stdlib::MacroArgument* target) {
  if (state.options.source != nullptr) return extendedArgument(state.options.source);
  return state.options.foreignMacros ? nullptr : target;
}

} // namespace

ExtendedSystems extendedSystems(const State& state, const stdlib::MacroSignature& signature, bool called) {
  const stdlib::MacroArgument* const target = extendedArgument(signature);
  if (called && target == nullptr) return {};
  return extendedNumbers(namedBySource(state, called ? target : nullptr), called ? target : nullptr,
                         state.control);
}

std::string offsetText(State& state, const ir::OffsetSetting& setting, ir::Axis axis,
                       const stdlib::MacroSignature& signature, const ir::Origin& origin) {
  const ir::ExpressionPtr& system = setting.system;
  const ir::ExpressionPtr number = offsetNumber(state.control, system, axis);
  const ExtendedSystems extended = extendedSystems(state, signature, false);
  if (extended.first == 0) return machineText(state, number, origin);
  const stdlib::SystemVariables& v = state.control.variables;
  const ir::ExpressionPtr from =
      tidy(ir::binary(ir::BinaryOp::Subtract, system, ir::constant(extended.first)));
  const int first = *v.extendedX + static_cast<int>(ir::indexOf(axis)) * v.axisStep;
  const ir::ExpressionPtr beyond = tidy(ir::binary(
      ir::BinaryOp::Add, ir::constant(first),
      ir::binary(ir::BinaryOp::Multiply, ir::constant(v.extendedStep), beyondIndex(from, extended))));
  if (isBeyond(state.cycle, system, extended)) return machineText(state, beyond, origin);
  if (ir::constantValue(tidy(system)) != nullptr || confinedTo(state, system, kFirstSystem, kLastSystem))
    return machineText(state, number, origin);
  const std::uint32_t helper = state.helper();
  if (helper == 0) {
    state.refuse<diag::TooManyLocals>(state.cycle.range, "the work system", state.control.locals);
    return "#0";
  }
  const std::string left = "#" + std::to_string(helper);
  state.sheet.add(left + "=" + valueText(state, number, origin), origin);
  doIf(state, ir::compare(ir::Relation::Greater, tidy(system), ir::constant(kLastSystem)),
       left + "=" + valueText(state, beyond, origin), origin);
  return "#[" + left + "]";
}

ir::ExpressionPtr systemForCall(State& state, const ir::ExpressionPtr& system,
                                const stdlib::MacroSignature& signature, const ir::Origin& origin) {
  const stdlib::MacroArgument* const target = extendedArgument(signature);
  const stdlib::MacroArgument* const source = target == nullptr ? nullptr : namedBySource(state, target);
  if (source == nullptr || !state.control.variables.extendedX) return system;
  if (source->extendedFirst == target->extendedFirst && source->extendedStep == target->extendedStep)
    return system;
  const ir::ExpressionPtr given =
      tidy(ir::binary(ir::BinaryOp::Subtract, system, ir::constant(kFirstSystem - 1)));
  if (const double* value = ir::constantValue(given)) {
    const std::uint32_t n = stdlib::extendedSystem(*source, *value);
    return n == 0 ? system
                  : ir::constant(stdlib::extendedNumber(*target, n) + kFirstSystem - 1, system->range);
  }
  if (confinedTo(state, system, kFirstSystem, kLastSystem)) return system;
  const std::uint32_t helper = state.helper();
  if (helper == 0) {
    state.refuse<diag::TooManyLocals>(state.cycle.range, "the work system", state.control.locals);
    return system;
  }
  const std::string left = "#" + std::to_string(helper);
  const ir::ExpressionPtr named = systemVariable(static_cast<int>(helper));
  state.sheet.add(left + "=" + valueText(state, given, origin), origin);
  const ir::ExpressionPtr there = ir::binary(
      ir::BinaryOp::Add, ir::constant(target->extendedFirst),
      ir::binary(target->extendedStep < source->extendedStep ? ir::BinaryOp::Divide : ir::BinaryOp::Multiply,
                 ir::binary(ir::BinaryOp::Subtract, named, ir::constant(source->extendedFirst)),
                 ir::constant(target->extendedStep < source->extendedStep
                                  ? source->extendedStep / target->extendedStep
                                  : target->extendedStep / source->extendedStep)));
  doIf(state, ir::compare(ir::Relation::Greater, named, ir::constant(kLastSystem - kFirstSystem + 1)),
       left + "=" + valueText(state, there, origin), origin);
  return ir::binary(ir::BinaryOp::Add, named, ir::constant(kFirstSystem - 1));
}

} // namespace dotek::backends::fanuc
