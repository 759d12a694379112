#include "ir/Walk.h"
#include "lint/NcProgram.h"

#include <algorithm>
#include <array>
#include <optional>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirstOffset = 5201, kLastOffset = 5320, kSystem = 20; // external, G54 to G59
constexpr std::string_view kAxes = "XYZ";

struct Place {
  std::uint32_t axis = 0, system = 0;
};

// A work offset of X, Y or Z.
std::optional<Place> offsetOf(std::uint32_t number) {
  if (number < kFirstOffset || number > kLastOffset) return std::nullopt;
  const Place out{(number - kFirstOffset) % kSystem, (number - kFirstOffset) / kSystem};
  return out.axis < kAxes.size() ? std::optional(out) : std::nullopt;
}

// What was measured along one axis: the contact of a G31, or what a vendor's macro leaves (`shift`: on a Haas
// 50 higher).
std::optional<std::uint32_t> measuredAxis(std::uint32_t number, std::uint32_t shift) {
  for (const std::uint32_t first : {5061U, 135 + shift, 140 + shift})
    if (number >= first && number < first + kAxes.size()) return number - first;
  return std::nullopt;
}

bool isTurned(const ir::ExpressionPtr& value) {
  bool out = false;
  ir::eachNode(value, [&](const ir::Expression& node) {
    const auto* unary = std::get_if<ir::Unary>(&node.node);
    out = out || (unary != nullptr && (unary->op == ir::UnaryOp::Sine || unary->op == ir::UnaryOp::Cosine ||
                                       unary->op == ir::UnaryOp::Tangent));
  });
  return out;
}

void check(const NcProgram& nc, Report& report) {
  const stdlib::Control* const control = nc.project.control;
  const std::uint32_t shift =
      control != nullptr && control->package ? static_cast<std::uint32_t>(control->package->shift) : 0;
  for (const ir::ProgramStatement& statement : nc.program.body) {
    const auto* store = std::get_if<ir::Store>(&statement.node);
    const auto number = store == nullptr ? std::nullopt : storedNumber(statement);
    const auto target = number ? offsetOf(*number) : std::nullopt;
    if (!target || isTurned(store->value)) continue;
    std::optional<std::uint32_t> measured, other; // variables
    bool own = false, several = false;
    ir::eachNode(store->value, [&](const ir::Expression& node) {
      const auto read =
          std::holds_alternative<ir::MachineVariable>(node.node) ? variableNumber(node) : std::nullopt;
      if (!read) return;
      if (const auto axis = measuredAxis(*read, shift)) {
        own = own || *axis == target->axis;
        several = several || (measured && measuredAxis(*measured, shift) != axis);
        measured = read;
      } else if (const auto place = offsetOf(*read); place && place->axis != target->axis) {
        other = read;
      } else if (place) {
        own = own || !measured;
      }
    });
    if (!measured || several) continue;
    const std::uint32_t axis = *measuredAxis(*measured, shift);
    const bool crossed = axis != target->axis;
    if (!crossed && !other) continue;
    const std::uint32_t wrong = crossed ? *measured : *other;
    const char from = kAxes[crossed ? axis : offsetOf(*other)->axis];
    report.at(statement.origin.range(),
              "#{} is {} of a work offset, and #{} belongs to {}; the part is measured along one axis and "
              "shifted along the other; write the two numbers of one axis",
              *number, kAxes[target->axis], wrong, from);
  }
}

} // namespace

DOTEK_LINT_RULE(offset_of_other_axis){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
