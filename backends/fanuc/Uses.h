// Which variables a cycle reads and writes, and what depends on them.
#pragma once

#include "ir/Cycle.h"
#include "stdlib/Control.h"

#include <set>

namespace dotek::backends::fanuc {

std::set<ir::VariableId> variablesOf(const ir::ExpressionPtr& expression);
std::set<ir::VariableId> variablesOf(const ir::ConditionPtr& condition);
// Read or assigned in checks or body.
std::set<ir::VariableId> usedVariables(const ir::Cycle& cycle);
bool isAssigned(const std::vector<ir::CycleStatement>& list, ir::VariableId id);
// start_x, start_y, start_z.
bool isStartHost(const ir::Variable& variable);
// Variables that reach a coordinate, travel, diameter or feed of a move or a measurement, directly, through
// assignments, or by choosing which of them happen; not those that only choose an alarm. `control`: of the
// blocks that are copied.
std::set<ir::VariableId> movingVariables(const ir::Cycle& cycle, const stdlib::Control& control);
// Variables that reach anything that the body does: read there, or in assignments to what is read there, or
// where the checks choose among such assignments. What checks alone read is not among them.
std::set<ir::VariableId> bodyVariables(const ir::Cycle& cycle);
// Statements that may follow each statement, whatever many later, itself only in a loop.
std::vector<bool> reachableFrom(const std::vector<std::vector<std::size_t>>& next, std::size_t from);

} // namespace dotek::backends::fanuc
