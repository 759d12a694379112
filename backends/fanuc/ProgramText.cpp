#include "backends/fanuc/ProgramText.h"

#include "backends/fanuc/MacroNames.h"
#include "support/Decimal.h"

#include <algorithm>
#include <limits>

namespace dotek::backends::fanuc {

namespace {

const ir::ExpressionPtr& withoutNull(const ir::ExpressionPtr& expression) {
  const auto* unary = std::get_if<ir::Unary>(&expression->node);
  return unary != nullptr && unary->op == ir::UnaryOp::NullAsZero ? withoutNull(unary->operand) : expression;
}

const ir::Unary* negation(const ir::ExpressionPtr& expression) {
  const auto* unary = std::get_if<ir::Unary>(&expression->node);
  return unary != nullptr && unary->op == ir::UnaryOp::Negate ? unary : nullptr;
}

bool isVariable(const ir::ExpressionPtr& expression) {
  return std::holds_alternative<ir::MachineVariable>(expression->node) ||
         std::holds_alternative<ir::NullValue>(expression->node);
}

std::string digitsOf(const ir::Constant& constant) {
  return constant.digits.empty() ? numberText(constant.value) : constant.digits;
}

bool isSigned(const ir::ExpressionPtr& expression) {
  if (negation(expression) != nullptr) return true;
  const auto* constant = std::get_if<ir::Constant>(&expression->node);
  return constant != nullptr && digitsOf(*constant).starts_with('-');
}

std::string bracketed(const std::string& text) {
  return "[" + text + "]";
}

// Programs keep what their source writes: digits, signs, and null where it counts as 0 anyway.
class SourcePrinter : public ExpressionPrinter {
public:
  SourcePrinter(const ProgramText& program, bool comma)
      : ExpressionPrinter(notation_), program_(program), comma_(comma) {}

protected:
  std::string leaf(const ir::ExpressionPtr& expression, std::uint32_t) override {
    if (const auto* constant = std::get_if<ir::Constant>(&expression->node)) return digitsOf(*constant);
    if (const auto* machine = std::get_if<ir::MachineVariable>(&expression->node))
      return program_.variable(machine->number);
    return "#0"; // null; the rest was refused
  }
  std::string aside(const ir::ExpressionPtr&) override { return "#0"; } // refused before

  ir::ExpressionPtr shown(const ir::ExpressionPtr& expression) const override {
    return withoutNull(expression);
  }
  bool isSigned(const ir::ExpressionPtr& expression) const override { return fanuc::isSigned(expression); }
  bool leftTakesSign(const Infix& infix, bool first) const override {
    return first && infix.text.size() == 1;
  }

  std::string negated(const ir::ExpressionPtr& given, std::uint32_t depth) override {
    const ir::ExpressionPtr& operand = withoutNull(given);
    const auto* constant = std::get_if<ir::Constant>(&operand->node);
    // -[5.] keeps apart from the number -5.
    const bool brackets = std::holds_alternative<ir::Binary>(operand->node) || isSigned(operand) ||
                          (constant != nullptr && constant->value != 0);
    const std::string inner = print(operand, depth);
    return "-" + (brackets ? fanuc::bracketed(inner) : inner);
  }
  std::string operation(const ir::Binary& binary, const ir::ExpressionPtr&, std::uint32_t depth) override {
    const std::string left = print(binary.left, depth), right = print(binary.right, depth);
    if (binary.op == ir::BinaryOp::Power) return "POW[" + left + "," + right + "]";
    return comma_ ? "ATAN[" + right + "," + left + "]" : "ATAN[" + right + "]/[" + left + "]";
  }
  int levelOf(const ir::ExpressionPtr& expression) const override {
    const auto* binary = std::get_if<ir::Binary>(&expression->node);
    // The slash of ATAN reads as one of a product.
    if (binary != nullptr && binary->op == ir::BinaryOp::Bearing && !comma_) return kMultiplicative;
    return ExpressionPrinter::levelOf(expression);
  }

private:
  const ProgramText& program_;
  bool comma_;
  MacroNotation notation_;
};

} // namespace

std::uint32_t bracketDepth(std::string_view text) {
  std::uint32_t open = 0;
  std::uint32_t most = 0;
  bool comment = false;
  for (const char c : text) {
    comment = comment || c == '(';
    if (c == ')') comment = false;
    if (comment) continue;
    if (c == '[') most = std::max(most, ++open);
    if (c == ']' && open > 0) --open;
  }
  return most;
}

ProgramText::ProgramText(const stdlib::Control& control)
    : comma_(!control.functions.contains("ATAN[y]/[x]") && control.functions.contains("ATAN[y,x]")) {}

std::string ProgramText::variable(const ir::ExpressionPtr& given) const {
  const ir::ExpressionPtr& number = withoutNull(given);
  const auto* constant = std::get_if<ir::Constant>(&number->node);
  // A number with a point is in brackets only.
  if (constant != nullptr && digitsOf(*constant).find_first_not_of("0123456789") == std::string::npos)
    return "#" + digitsOf(*constant);
  return "#" + bracketed(text(number));
}

std::string ProgramText::text(const ir::ExpressionPtr& expression) const {
  return SourcePrinter(*this, comma_).print(expression, std::numeric_limits<std::uint32_t>::max());
}

std::string ProgramText::number(const ir::ExpressionPtr& expression) const {
  return text(expression);
}

std::string ProgramText::value(const ir::ExpressionPtr& expression) const {
  const std::string inner = text(expression);
  return &withoutNull(expression) == &expression ? inner : bracketed(inner);
}

std::string ProgramText::word(const ir::ExpressionPtr& expression) const {
  // A number without digits of its own was computed: in brackets it counts no increments.
  if (const auto* constant = std::get_if<ir::Constant>(&expression->node))
    return constant->digits.empty() ? bracketed(digitsOf(*constant)) : constant->digits;
  if (isVariable(expression)) return text(expression);
  if (const ir::Unary* minus = negation(expression)) {
    const bool plain = !std::holds_alternative<ir::Unary>(minus->operand->node);
    if (plain) return text(expression);
  }
  return bracketed(text(expression));
}

std::string ProgramText::target(const ir::ExpressionPtr& expression) const {
  const ir::ExpressionPtr& inner = withoutNull(expression);
  return word(isVariable(inner) ? inner : expression);
}

std::string ProgramText::comparison(const ir::Comparison& comparison) const {
  const std::string_view name = relationName(comparison.relation);
  const bool keepsNull = name == "EQ" || name == "NE"; // the others compare with 0
  const auto side = [&](const ir::ExpressionPtr& one) { return keepsNull ? value(one) : number(one); };
  return bracketed(side(comparison.left) + " " + std::string(name) + " " + side(comparison.right));
}

// Joins inside joins are in brackets, unless all are the same: sources disagree on which binds first.
std::string ProgramText::joined(const ir::Junction& junction) const {
  const bool both = junction.op == ir::Connective::And;
  const auto* left = std::get_if<ir::Junction>(&junction.left->node);
  const auto* right = std::get_if<ir::Junction>(&junction.right->node);
  // [a AND NOT b] OR [NOT a AND b] is XOR.
  if (!both && left != nullptr && right != nullptr && left->op == ir::Connective::And &&
      right->op == ir::Connective::And && ir::equal(ir::negate(left->left), right->left) &&
      ir::equal(left->right, ir::negate(right->right)))
    return condition(left->left) + " XOR " + condition(right->right);
  std::string first = condition(junction.left);
  if (left != nullptr && left->op == junction.op) {
    const std::string plain = joined(*left);
    if (plain.find(" XOR ") == std::string::npos) first = plain;
  }
  return first + (both ? " AND " : " OR ") + condition(junction.right);
}

std::string ProgramText::condition(const ir::ConditionPtr& condition) const {
  if (const auto* one = std::get_if<ir::Comparison>(&condition->node)) return comparison(*one);
  if (const auto* null = std::get_if<ir::IsNull>(&condition->node))
    return bracketed(value(null->value) + " EQ #0");
  if (const auto* truth = std::get_if<ir::Truth>(&condition->node))
    return truth->value ? "[1 EQ 1]" : "[1 EQ 0]";
  if (const auto* junction = std::get_if<ir::Junction>(&condition->node)) return bracketed(joined(*junction));
  const auto& inner = std::get<ir::Not>(condition->node).inner;
  if (const auto* null = std::get_if<ir::IsNull>(&inner->node))
    return bracketed(value(null->value) + " NE #0");
  return this->condition(ir::negate(inner));
}

} // namespace dotek::backends::fanuc
