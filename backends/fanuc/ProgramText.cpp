#include "backends/fanuc/ProgramText.h"

#include "support/Decimal.h"

#include <algorithm>

namespace dotek::backends::fanuc {

namespace {

constexpr int kSum = 1;
constexpr int kProduct = 2;
constexpr int kAtom = 3;

struct Infix {
  std::string_view text;
  int level = kAtom; // kAtom: no infix operator
};

Infix infixOf(ir::BinaryOp op) {
  using Op = ir::BinaryOp;
  switch (op) {
  case Op::Add: return {"+", kSum};
  case Op::Subtract: return {"-", kSum};
  case Op::RoundedOr:
  case Op::BitOr: return {" OR ", kSum};
  case Op::RoundedXor:
  case Op::BitXor: return {" XOR ", kSum};
  case Op::Multiply: return {"*", kProduct};
  case Op::Divide: return {"/", kProduct};
  case Op::RoundedAnd:
  case Op::BitAnd: return {" AND ", kProduct};
  case Op::RoundedModulo:
  case Op::Modulo: return {" MOD ", kProduct};
  case Op::Power:
  case Op::Bearing:
  case Op::Direction:
  case Op::ValueOr: return {};
  }
  return {};
}

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

// ATAN of one operand at the end: what stands behind a `/` would become its second operand.
bool endsWithArcTangent(std::string_view text) {
  if (!text.ends_with(']')) return false;
  int open = 0;
  for (std::size_t at = text.size(); at-- > 0;) {
    if (text[at] == ']') ++open;
    if (text[at] == '[' && --open == 0) return text.substr(0, at).ends_with("ATAN");
  }
  return false;
}

} // namespace

std::string_view functionKey(ir::UnaryOp op) {
  using Op = ir::UnaryOp;
  switch (op) {
  case Op::Absolute: return "ABS";
  case Op::Truncate: return "FIX";
  case Op::RoundUp: return "FUP";
  case Op::Round:
  case Op::RoundIncrement: return "ROUND";
  case Op::SquareRoot: return "SQRT";
  case Op::Sine: return "SIN";
  case Op::Cosine: return "COS";
  case Op::Tangent: return "TAN";
  case Op::ArcSine: return "ASIN";
  case Op::ArcCosine: return "ACOS";
  case Op::ArcTangent: return "ATAN";
  case Op::Logarithm: return "LN";
  case Op::Exponential: return "EXP";
  case Op::FromBcd: return "BIN";
  case Op::ToBcd: return "BCD";
  case Op::AddPoint: return "ADP";
  case Op::Negate:
  case Op::NullAsZero: return "";
  }
  return "";
}

std::string_view functionKey(ir::BinaryOp op) {
  using Op = ir::BinaryOp;
  switch (op) {
  case Op::RoundedAnd: return "AND";
  case Op::RoundedOr: return "OR";
  case Op::RoundedXor: return "XOR";
  case Op::RoundedModulo: return "MOD";
  case Op::Power: return "POW";
  case Op::Bearing: return "ATAN";
  case Op::Add:
  case Op::Subtract:
  case Op::Multiply:
  case Op::Divide:
  case Op::Modulo:
  case Op::Direction:
  case Op::BitAnd:
  case Op::BitOr:
  case Op::BitXor:
  case Op::ValueOr: break;
  }
  return "";
}

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
  // A number with a point stands in brackets only.
  if (constant != nullptr && digitsOf(*constant).find_first_not_of("0123456789") == std::string::npos)
    return "#" + digitsOf(*constant);
  return "#" + bracketed(text(number, true));
}

std::string ProgramText::negated(const ir::ExpressionPtr& given) const {
  const ir::ExpressionPtr& operand = withoutNull(given);
  const auto* constant = std::get_if<ir::Constant>(&operand->node);
  // -[5.] keeps apart from the number -5.
  const bool brackets = std::holds_alternative<ir::Binary>(operand->node) || isSigned(operand) ||
                        (constant != nullptr && constant->value != 0);
  const std::string inner = text(operand, true);
  return "-" + (brackets ? bracketed(inner) : inner);
}

std::string ProgramText::unary(const ir::Unary& unary) const {
  return std::string(functionKey(unary.op)) + bracketed(text(unary.operand, true));
}

std::string ProgramText::binary(const ir::Binary& binary, bool first) const {
  const Infix infix = infixOf(binary.op);
  if (infix.level == kAtom) {
    if (binary.op == ir::BinaryOp::Power)
      return "POW[" + text(binary.left, true) + "," + text(binary.right, true) + "]";
    const std::string x = text(binary.left, true);
    const std::string y = text(binary.right, true);
    return comma_ ? "ATAN[" + y + "," + x + "]" : "ATAN[" + y + "]/[" + x + "]";
  }
  const bool words = infix.text.size() > 1;
  std::string left = operand(binary.left, infix.level, false, first && !words);
  const std::string right = operand(binary.right, infix.level, true, false);
  if (binary.op == ir::BinaryOp::Divide && endsWithArcTangent(left)) left = bracketed(left);
  return left + std::string(infix.text) + right;
}

std::string ProgramText::operand(const ir::ExpressionPtr& given, int level, bool right, bool first) const {
  const ir::ExpressionPtr& expression = withoutNull(given);
  int own = kAtom;
  if (const auto* binary = std::get_if<ir::Binary>(&expression->node)) {
    own = infixOf(binary->op).level;
    // The slash of ATAN reads as one of a product.
    if (binary->op == ir::BinaryOp::Bearing && !comma_) own = kProduct;
  }
  const bool bare = isSigned(expression) ? first && !right : right ? own > level : own >= level;
  return bare ? text(expression, first) : bracketed(text(expression, true));
}

// `first`: a bracket or the statement begins here, so that a sign may stand.
std::string ProgramText::text(const ir::ExpressionPtr& given, bool first) const {
  const ir::ExpressionPtr& expression = withoutNull(given);
  if (const auto* constant = std::get_if<ir::Constant>(&expression->node)) return digitsOf(*constant);
  if (const auto* machine = std::get_if<ir::MachineVariable>(&expression->node))
    return variable(machine->number);
  if (const auto* pair = std::get_if<ir::Binary>(&expression->node)) return binary(*pair, first);
  if (const ir::Unary* minus = negation(expression)) return negated(minus->operand);
  if (const auto* call = std::get_if<ir::Unary>(&expression->node)) return unary(*call);
  return "#0"; // null; the rest was refused
}

std::string ProgramText::number(const ir::ExpressionPtr& expression) const {
  return text(expression, true);
}

std::string ProgramText::value(const ir::ExpressionPtr& expression) const {
  const std::string inner = text(expression, true);
  return &withoutNull(expression) == &expression ? inner : bracketed(inner);
}

std::string ProgramText::word(const ir::ExpressionPtr& expression) const {
  // A number without digits of its own was computed: in brackets it counts no increments.
  if (const auto* constant = std::get_if<ir::Constant>(&expression->node))
    return constant->digits.empty() ? bracketed(digitsOf(*constant)) : constant->digits;
  if (isVariable(expression)) return text(expression, true);
  if (const ir::Unary* minus = negation(expression)) {
    const bool plain = !std::holds_alternative<ir::Unary>(minus->operand->node);
    if (plain) return negated(minus->operand);
  }
  return bracketed(text(expression, true));
}

std::string ProgramText::target(const ir::ExpressionPtr& expression) const {
  const ir::ExpressionPtr& inner = withoutNull(expression);
  return word(isVariable(inner) ? inner : expression);
}

std::string ProgramText::comparison(const ir::Comparison& comparison) const {
  const auto side = [&](const std::string& left, const char* relation, const std::string& right) {
    return bracketed(left + " " + relation + " " + right);
  };
  using Relation = ir::Relation;
  switch (comparison.relation) {
  case Relation::Equal:
  case Relation::Same: return side(value(comparison.left), "EQ", value(comparison.right));
  case Relation::NotEqual:
  case Relation::Different: return side(value(comparison.left), "NE", value(comparison.right));
  case Relation::Less: return side(number(comparison.left), "LT", number(comparison.right));
  case Relation::Greater: return side(number(comparison.left), "GT", number(comparison.right));
  case Relation::LessEqual: return side(number(comparison.left), "LE", number(comparison.right));
  case Relation::GreaterEqual: return side(number(comparison.left), "GE", number(comparison.right));
  }
  return "";
}

// Joins inside joins stand in brackets, unless all are the same: sources disagree on which binds first.
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
