// What Macro B calls functions and operators: one table for cycles and for programs. Private to the Fanuc
// back end.
#pragma once

#include "backends/common/ExpressionPrinter.h"
#include "ir/Expression.h"

#include <string_view>

namespace dotek::backends::fanuc {

// The name that the profile's list of functions has for it; "": no function, or no Macro B has it.
std::string_view functionKey(ir::UnaryOp op);
std::string_view functionKey(ir::BinaryOp op);
// `+`, ` AND `; without text where the operator is none between two operands.
Infix infixOf(ir::BinaryOp op);

std::string_view relationName(ir::Relation relation); // "EQ"

// Brackets of Macro B.
class MacroNotation : public Notation {
public:
  std::string_view function(ir::UnaryOp op) const override { return functionKey(op); }
  Infix infix(ir::BinaryOp op) const override { return infixOf(op); }
  // What follows ATAN of one operand after a `/` would become its second operand.
  bool bracketsLeft(ir::BinaryOp op, std::string_view left) const override;
};

} // namespace dotek::backends::fanuc
