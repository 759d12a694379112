#include "backends/fanuc/MacroNames.h"

namespace dotek::backends::fanuc {

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
  case Op::BitAnd:
  case Op::BitOr:
  case Op::BitXor:
  case Op::Direction:
  case Op::ValueOr: return "";
  }
  return "";
}

Infix infixOf(ir::BinaryOp op) {
  using Op = ir::BinaryOp;
  switch (op) {
  case Op::Add: return {"+", kAdditive};
  case Op::Subtract: return {"-", kAdditive};
  case Op::RoundedOr:
  case Op::BitOr: return {" OR ", kAdditive};
  case Op::RoundedXor:
  case Op::BitXor: return {" XOR ", kAdditive};
  case Op::Multiply: return {"*", kMultiplicative};
  case Op::Divide: return {"/", kMultiplicative};
  case Op::RoundedAnd:
  case Op::BitAnd: return {" AND ", kMultiplicative};
  case Op::RoundedModulo:
  case Op::Modulo: return {" MOD ", kMultiplicative};
  case Op::Power:
  case Op::Bearing:
  case Op::Direction:
  case Op::ValueOr: return {};
  }
  return {};
}

std::string_view relationName(ir::Relation relation) {
  switch (relation) {
  case ir::Relation::Same:
  case ir::Relation::Equal: return "EQ";
  case ir::Relation::Different:
  case ir::Relation::NotEqual: return "NE";
  case ir::Relation::Less: return "LT";
  case ir::Relation::Greater: return "GT";
  case ir::Relation::LessEqual: return "LE";
  case ir::Relation::GreaterEqual: return "GE";
  }
  return "";
}

bool MacroNotation::bracketsLeft(ir::BinaryOp op, std::string_view left) const {
  if (op != ir::BinaryOp::Divide || !left.ends_with(']')) return false;
  int open = 0;
  for (std::size_t at = left.size(); at-- > 0;) {
    if (left[at] == ']') ++open;
    if (left[at] == '[' && --open == 0) return left.substr(0, at).ends_with("ATAN");
  }
  return false;
}

} // namespace dotek::backends::fanuc
