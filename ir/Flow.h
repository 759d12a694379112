// Control flow of a statement list.
#pragma once

#include "ir/Cycle.h"
#include "ir/Program.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dotek::ir {

// Indices of the statements that may follow each statement of a cycle or a program (a computed jump: all
// labels); `list.size()` is the end. Return and Exit go to the end, Alarm and Raise to none. Codes mean
// nothing here: a block with M30 goes on at the next one.
std::vector<std::vector<std::size_t>> successors(const std::vector<CycleStatement>& list);
std::vector<std::vector<std::size_t>> successors(const std::vector<ProgramStatement>& list);
// The label that a Jump or a Branch goes to; nothing: another statement, or a computed jump.
std::optional<LabelId> targetOf(const CycleStatement& statement);
std::optional<LabelId> targetOf(const ProgramStatement& statement);
// A Label or a Comment: nothing is carried out there.
bool isLayout(const CycleStatement& statement);
bool isLayout(const ProgramStatement& statement);
std::vector<bool> reachable(const std::vector<CycleStatement>& list);
std::vector<bool> reachable(const std::vector<ProgramStatement>& list);

} // namespace dotek::ir
