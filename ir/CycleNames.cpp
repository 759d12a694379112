#include "ir/CycleNames.h"

#include <iterator>

namespace dotek::ir {
namespace {

double baseOf(ToolPart part) {
  return kToolTable + kToolPartStep * static_cast<double>(part);
}

} // namespace

std::string_view toolPartText(ToolPart part) {
  constexpr std::string_view kTexts[] = {"length", "length wear", "radius", "radius wear"};
  return kTexts[static_cast<std::size_t>(part)];
}

bool isLength(ToolPart part) {
  return part == ToolPart::Length || part == ToolPart::LengthWear;
}

bool isWear(ToolPart part) {
  return part == ToolPart::LengthWear || part == ToolPart::RadiusWear;
}

ExpressionPtr toolValue(ToolPart part, const ExpressionPtr& tool, SourceRange range) {
  return machineVariable(binary(BinaryOp::Add, constant(baseOf(part)), tool, range), range);
}

std::optional<std::pair<ToolPart, double>> toolOf(double number) {
  const double beyond = number - kToolTable;
  if (!(beyond >= 0 && beyond < kToolPartStep * static_cast<double>(std::size(kToolParts))))
    return std::nullopt;
  const auto part = static_cast<std::size_t>(beyond / kToolPartStep);
  return std::pair(kToolParts[part], beyond - kToolPartStep * static_cast<double>(part));
}

std::optional<std::pair<ToolPart, ExpressionPtr>> readTool(const Expression& value) {
  const auto* machine = std::get_if<MachineVariable>(&value.node);
  if (machine == nullptr) return std::nullopt;
  if (const double* number = constantValue(machine->number)) {
    const auto found = toolOf(*number);
    if (!found) return std::nullopt;
    return std::pair(found->first, constant(found->second, machine->number->range));
  }
  const auto* sum = std::get_if<Binary>(&machine->number->node);
  const double* base = sum != nullptr && sum->op == BinaryOp::Add ? constantValue(sum->left) : nullptr;
  for (const ToolPart part : kToolParts)
    if (base != nullptr && *base == baseOf(part)) return std::pair(part, sum->right);
  return std::nullopt;
}

ExpressionPtr handedBack(std::size_t index, SourceRange range) {
  return machineVariable(constant(kHandedBack + static_cast<double>(index)), range);
}

std::optional<std::size_t> handedBackOf(const Expression& value) {
  const auto* machine = std::get_if<MachineVariable>(&value.node);
  const double* number = machine == nullptr ? nullptr : constantValue(machine->number);
  if (number == nullptr || !(*number >= kHandedBack && *number < kToolTable)) return std::nullopt;
  return static_cast<std::size_t>(*number - kHandedBack);
}

} // namespace dotek::ir
