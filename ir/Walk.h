// Ways through the expressions of a statement.
#pragma once

#include "ir/Cycle.h"

#include <functional>

namespace dotek::ir {

// Each expression slot of the statement that is filled, those of its condition excepted; an empty slot stays
// empty. Words of an opaque block and the number of a machine variable that is stored are slots, too.
void eachSlot(Statement& statement, const std::function<void(ExpressionPtr&)>& visit);
void eachSlot(const Statement& statement, const std::function<void(const ExpressionPtr&)>& visit);

// Each node of the tree, the root first.
void eachNode(const ExpressionPtr& expression, const std::function<void(const Expression&)>& visit);
// Each node of the expressions that are compared.
void eachNode(const ConditionPtr& condition, const std::function<void(const Expression&)>& visit);
// Each node of all that the statement reads: slots and condition. What an Assign writes is not read.
void eachNode(const Statement& statement, const std::function<void(const Expression&)>& visit);

} // namespace dotek::ir
