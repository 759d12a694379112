#include "ir/CycleNames.h"
#include "ir/Names.h"
#include "ir/Print.h"

#include <fmt/format.h>
#include <string_view>

namespace dotek::ir {
namespace {

// How tight an expression binds.
enum class Level : std::uint8_t { Sum, Product, Primary };

std::string_view functionOf(UnaryOp op) {
  switch (op) {
  case UnaryOp::Negate: return "-";
  case UnaryOp::Absolute: return "abs";
  case UnaryOp::Truncate: return "trunc";
  case UnaryOp::RoundUp: return "round_up";
  case UnaryOp::Round: return "round";
  case UnaryOp::SquareRoot: return "sqrt";
  case UnaryOp::Sine: return "sin";
  case UnaryOp::Cosine: return "cos";
  case UnaryOp::Tangent: return "tan";
  case UnaryOp::ArcSine: return "asin";
  case UnaryOp::ArcCosine: return "acos";
  case UnaryOp::ArcTangent: return "atan";
  case UnaryOp::Logarithm: return "ln";
  case UnaryOp::Exponential: return "exp";
  case UnaryOp::NullAsZero: return "or_zero";
  case UnaryOp::RoundIncrement: return "round_increment";
  case UnaryOp::FromBcd: return "from_bcd";
  case UnaryOp::ToBcd: return "to_bcd";
  case UnaryOp::AddPoint: return "add_point";
  }
  return "";
}

struct Operator {
  std::string_view text;
  Level level; // Primary: a function of two arguments
};

Operator operatorOf(BinaryOp op) {
  switch (op) {
  case BinaryOp::Add: return {" + ", Level::Sum};
  case BinaryOp::Subtract: return {" - ", Level::Sum};
  case BinaryOp::Multiply: return {" * ", Level::Product};
  case BinaryOp::Divide: return {" / ", Level::Product};
  case BinaryOp::Modulo: return {" mod ", Level::Product};
  case BinaryOp::Direction: return {"direction", Level::Primary};
  case BinaryOp::BitAnd: return {"bitand", Level::Primary};
  case BinaryOp::BitOr: return {"bitor", Level::Primary};
  case BinaryOp::BitXor: return {"bitxor", Level::Primary};
  case BinaryOp::ValueOr: return {"value_or", Level::Primary};
  case BinaryOp::RoundedAnd: return {"rounded_and", Level::Primary};
  case BinaryOp::RoundedOr: return {"rounded_or", Level::Primary};
  case BinaryOp::RoundedXor: return {"rounded_xor", Level::Primary};
  case BinaryOp::RoundedModulo: return {"rounded_mod", Level::Primary};
  case BinaryOp::Power: return {"power", Level::Primary};
  case BinaryOp::Bearing: return {"bearing", Level::Primary};
  }
  return {"", Level::Primary};
}

std::string_view relationText(Relation relation) {
  switch (relation) {
  case Relation::Equal: return " = ";
  case Relation::NotEqual: return " <> ";
  case Relation::Less: return " < ";
  case Relation::Greater: return " > ";
  case Relation::LessEqual: return " <= ";
  case Relation::GreaterEqual: return " >= ";
  case Relation::Same: return " is ";
  case Relation::Different: return " is not ";
  }
  return "";
}

Level levelOf(const Expression& expression) {
  const auto* node = std::get_if<Binary>(&expression.node);
  return node ? operatorOf(node->op).level : Level::Primary;
}

void writeAt(const Expression& expression, Level least, const Names& names, std::string& out) {
  const bool brackets = levelOf(expression) < least;
  if (brackets) out += '(';
  write(expression, names, out);
  if (brackets) out += ')';
}

// No sign before it and nothing after it.
bool isBareNumber(const std::string& text) {
  return text.front() != '-' && text.find(' ') == std::string::npos;
}

void writeBinary(const Binary& node, const Names& names, std::string& out) {
  const auto [text, level] = operatorOf(node.op);
  if (level == Level::Primary) {
    out += text;
    out += '(';
    write(*node.left, names, out);
    out += ", ";
    write(*node.right, names, out);
    out += ')';
    return;
  }
  writeAt(*node.left, level, names, out);
  out += text;
  writeAt(*node.right, level == Level::Sum ? Level::Product : Level::Primary, names, out);
}

void writeBrackets(const Condition& condition, bool brackets, const Names& names, std::string& out) {
  if (brackets) out += '(';
  write(condition, names, out);
  if (brackets) out += ')';
}

bool isJunction(const ConditionPtr& condition, Connective op) {
  const auto* node = std::get_if<Junction>(&condition->node);
  return node && node->op == op;
}

void writeJunction(const Junction& node, const Names& names, std::string& out) {
  const bool both = node.op == Connective::And;
  writeBrackets(*node.left, both && isJunction(node.left, Connective::Or), names, out);
  out += both ? " and " : " or ";
  const bool nested = isJunction(node.right, node.op) || (both && isJunction(node.right, Connective::Or));
  writeBrackets(*node.right, nested, names, out);
}

} // namespace

void writePrimary(const Expression& expression, const Names& names, std::string& out) {
  const auto* constant = std::get_if<Constant>(&expression.node);
  const bool bare =
      constant ? isBareNumber(names.number(*constant)) : std::holds_alternative<VariableUse>(expression.node);
  if (!bare) out += '(';
  write(expression, names, out);
  if (!bare) out += ')';
}

void write(const Expression& expression, const Names& names, std::string& out) {
  if (const auto* constant = std::get_if<Constant>(&expression.node)) {
    out += names.number(*constant);
  } else if (const auto* use = std::get_if<VariableUse>(&expression.node)) {
    out += names.variable(use->variable);
  } else if (const auto* machine = std::get_if<MachineVariable>(&expression.node)) {
    const auto tool = readTool(expression);
    out += tool ? "tool " : "#";
    writePrimary(tool ? *tool->second : *machine->number, names, out);
    if (tool) out += fmt::format(" {}", toolPartText(tool->first));
  } else if (const auto* measured = std::get_if<MeasuredResult>(&expression.node)) {
    out += "result ";
    out += resultText(measured->name);
  } else if (const auto* one = std::get_if<Unary>(&expression.node)) {
    out += functionOf(one->op);
    if (one->op == UnaryOp::Negate && std::holds_alternative<VariableUse>(one->operand->node)) {
      write(*one->operand, names, out);
      return;
    }
    out += '(';
    write(*one->operand, names, out);
    out += ')';
  } else if (const auto* two = std::get_if<Binary>(&expression.node)) {
    writeBinary(*two, names, out);
  } else {
    out += "null";
  }
}

void write(const Condition& condition, const Names& names, std::string& out) {
  if (const auto* comparison = std::get_if<Comparison>(&condition.node)) {
    write(*comparison->left, names, out);
    out += relationText(comparison->relation);
    write(*comparison->right, names, out);
  } else if (const auto* null = std::get_if<IsNull>(&condition.node)) {
    write(*null->value, names, out);
    out += " is null";
  } else if (const auto* negated = std::get_if<Not>(&condition.node)) {
    const auto* absent = std::get_if<IsNull>(&negated->inner->node);
    if (absent) {
      write(*absent->value, names, out);
      out += " is not null";
    } else {
      out += "not ";
      writeBrackets(*negated->inner, true, names, out);
    }
  } else if (const auto* junction = std::get_if<Junction>(&condition.node)) {
    writeJunction(*junction, names, out);
  } else {
    out += std::get<Truth>(condition.node).value ? "true" : "false";
  }
}

std::string print(const Expression& expression, const Cycle& cycle) {
  std::string out;
  write(expression, Names(cycle), out);
  return out;
}

std::string print(const Condition& condition, const Cycle& cycle) {
  std::string out;
  write(condition, Names(cycle), out);
  return out;
}

} // namespace dotek::ir
