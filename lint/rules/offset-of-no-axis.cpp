#include "ir/Walk.h"
#include "lint/NcProgram.h"

#include <cmath>
#include <optional>

namespace dotek::lint::rule {
namespace {

constexpr int kMostAxes = 9; // of a machine, rotary ones too

// constant + step * something; no step: it is a constant.
struct Sum {
  double constant = 0;
  double step = 0;
};

std::optional<Sum> sumOf(const ir::ExpressionPtr& value) {
  if (value == nullptr) return std::nullopt;
  if (const double* constant = ir::constantValue(value)) return Sum{*constant, 0};
  if (std::holds_alternative<ir::MachineVariable>(value->node)) return Sum{0, 1};
  if (const auto* unary = std::get_if<ir::Unary>(&value->node)) {
    const bool asIs = unary->op == ir::UnaryOp::NullAsZero || unary->op == ir::UnaryOp::AddPoint;
    return asIs ? sumOf(unary->operand) : std::nullopt;
  }
  const auto* binary = std::get_if<ir::Binary>(&value->node);
  if (binary == nullptr) return std::nullopt;
  const auto left = sumOf(binary->left), right = sumOf(binary->right);
  if (!left || !right) return std::nullopt;
  if (binary->op == ir::BinaryOp::Multiply && (left->step == 0 || right->step == 0))
    return Sum{left->constant * right->constant, left->step * right->constant + right->step * left->constant};
  // Of two numbers that are not known nothing is said.
  if (left->step != 0 && right->step != 0) return std::nullopt;
  if (binary->op == ir::BinaryOp::Add) return Sum{left->constant + right->constant, left->step + right->step};
  if (binary->op == ir::BinaryOp::Subtract)
    return Sum{left->constant - right->constant, left->step - right->step};
  return std::nullopt;
}

// Where the offsets of one table lie: `first` is X of its first system.
struct Table {
  int first = 0, step = 0, axisStep = 1, count = 0;
};

void checkProgram(const NcProgram& nc, Report& report) {
  const stdlib::Control* control = nc.project.control;
  if (control == nullptr) return;
  const stdlib::SystemVariables& variables = control->variables;
  std::vector<Table> tables;
  if (variables.workOffsetX && variables.systemStep > variables.axisStep * kMostAxes)
    tables.push_back({*variables.workOffsetX, variables.systemStep, variables.axisStep, 6});
  if (variables.extendedX && variables.extendedStep > variables.axisStep * kMostAxes)
    tables.push_back(
        {*variables.extendedX, variables.extendedStep, variables.axisStep, variables.extendedCount});
  const auto judge = [&](const ir::ExpressionPtr& number, SourceRange range) {
    const auto sum = sumOf(number);
    if (!sum) return;
    for (const Table& table : tables) {
      if (sum->step != 0 && sum->step != table.step) continue;
      const double offset = sum->constant - table.first;
      // What is put in may count from 1.
      if (offset < (sum->step == 0 ? 0 : -table.step) || offset >= double(table.step) * table.count) continue;
      const double rest = offset - std::floor(offset / table.step) * table.step;
      if (rest != std::floor(rest) || rest < table.axisStep * kMostAxes) continue;
      report.at(range,
                "this is the offset of no axis: X of the first system is #{}, the other axes follow, and the "
                "next system begins {} higher; X is {} here; write the number of the axis that is meant",
                table.first, table.step,
                sum->step == 0 ? fmt::format("#{:.0f}", sum->constant - rest)
                               : fmt::format("#[{:.0f}+{}*..]", sum->constant - rest, table.step));
      return;
    }
  };
  for (const ir::ProgramStatement& statement : nc.program.body) {
    if (const auto* store = std::get_if<ir::Store>(&statement.node); store != nullptr && store->number)
      judge(store->number, store->number->range.hasPlace() ? store->number->range : statement.origin.range());
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* read = std::get_if<ir::MachineVariable>(&node.node))
        judge(read->number, node.range.hasPlace() ? node.range : statement.origin.range());
    });
  }
}

} // namespace

DOTEK_LINT_RULE(offset_of_no_axis){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = checkProgram,
};

} // namespace dotek::lint::rule
