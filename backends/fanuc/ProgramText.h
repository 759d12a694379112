// Expressions and conditions of programs in macro B, with the fewest brackets. Private to Program*.cpp.
#pragma once

#include "ir/Expression.h"
#include "stdlib/Control.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace dotek::backends::fanuc {

class ProgramText {
public:
  explicit ProgramText(const stdlib::Control& control);

  // Where null counts as 0: an operand, a function's argument, both sides of GT GE LT LE.
  std::string number(const ir::ExpressionPtr& expression) const;
  // Where null stays null: what is stored, both sides of EQ and NE.
  std::string value(const ir::ExpressionPtr& expression) const;
  // After an address: a number, `#1`, `-#1`, or brackets.
  std::string word(const ir::ExpressionPtr& expression) const;
  // After GOTO: as after an address, and null counts as 0.
  std::string target(const ir::ExpressionPtr& expression) const;
  // `#5`, `#[..]`.
  std::string variable(const ir::ExpressionPtr& number) const;
  // In its brackets: `[#1 EQ 2]`.
  std::string condition(const ir::ConditionPtr& condition) const;

private:
  std::string text(const ir::ExpressionPtr& expression) const;
  std::string comparison(const ir::Comparison& comparison) const;
  std::string joined(const ir::Junction& junction) const;

  bool comma_ = false; // ATAN[y,x] is the only form with two operands
};

// How deep brackets lie in the text, comments aside.
std::uint32_t bracketDepth(std::string_view text);

} // namespace dotek::backends::fanuc
