// Expressions and conditions of macro B as IR. Private to the lowering.
#pragma once

#include "frontend/macrob/Ast.h"
#include "ir/Expression.h"

#include <cstdint>

namespace dotek::frontend::macrob {

// Where an expression is: ROUND means another thing after an address.
enum class Place : std::uint8_t { Statement, Word };

// A value that may be null: of a variable that is alone, `#1`. Everything else is a number.
ir::ExpressionPtr lowerValue(const Expression& expression, Place place);
// A number: null counts as 0.
ir::ExpressionPtr lowerNumber(const Expression& expression, Place place);
// Value of an address or an argument. `X-#1` with a null #1 has no value: whether the word is left out, or is
// 0, no source says.
ir::ExpressionPtr lowerWordValue(const Expression& expression, Place place);
ir::ConditionPtr lowerCondition(const Condition& condition);

} // namespace dotek::frontend::macrob
