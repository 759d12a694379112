// Ways through the expressions of a statement.
#pragma once

#include "ir/Statement.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace dotek::ir {

// Each expression slot of the statement that is filled, those of its condition excepted; an empty slot stays
// empty. Words of an opaque block and the number of a machine variable that is stored are slots, too.
void eachSlot(CycleStatement& statement, const std::function<void(ExpressionPtr&)>& visit);
void eachSlot(const CycleStatement& statement, const std::function<void(const ExpressionPtr&)>& visit);
void eachSlot(ProgramStatement& statement, const std::function<void(ExpressionPtr&)>& visit);
void eachSlot(const ProgramStatement& statement, const std::function<void(const ExpressionPtr&)>& visit);

// Each node of the tree, the root first.
void eachNode(const ExpressionPtr& expression, const std::function<void(const Expression&)>& visit);
// Each node of the expressions that are compared.
void eachNode(const ConditionPtr& condition, const std::function<void(const Expression&)>& visit);
// Each node of all that the statement reads: slots and condition. What an Assign writes is not read.
void eachNode(const CycleStatement& statement, const std::function<void(const Expression&)>& visit);
void eachNode(const ProgramStatement& statement, const std::function<void(const Expression&)>& visit);
// The condition of a Branch, or of a Loop that has one; nullptr: none.
ConditionPtr* conditionOf(CycleStatement& statement);
const ConditionPtr* conditionOf(const CycleStatement& statement);
ConditionPtr* conditionOf(ProgramStatement& statement);
const ConditionPtr* conditionOf(const ProgramStatement& statement);

// The constant that the computed number of a variable counts from: 2000 of #[2000+#7]. nullopt: none.
std::optional<std::uint32_t> firstNumber(const ExpressionPtr& number);

} // namespace dotek::ir
