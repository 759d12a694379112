// Control flow of a statement list.
#pragma once

#include "ir/Cycle.h"
#include "ir/Program.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dotek::ir {

// Indices of the statements that may follow each statement of a cycle or a program (a computed jump: all
// labels); `list.size()` is the end. Return, Exit and a block that ends the program go to the end, Alarm and
// Raise to none.
std::vector<std::vector<std::size_t>> successors(const std::vector<CycleStatement>& list);
std::vector<std::vector<std::size_t>> successors(const std::vector<ProgramStatement>& list);
// M30 or M2 that is written out, the same on every control; no cycle has them.
bool endsProgram(const CycleStatement& statement);
bool endsProgram(const ProgramStatement& statement);
// The label that a Jump or a Branch goes to; nothing: another statement, or a computed jump.
std::optional<LabelId> targetOf(const CycleStatement& statement);
std::optional<LabelId> targetOf(const ProgramStatement& statement);
// A Label or a Comment: nothing is carried out there.
bool isLayout(const CycleStatement& statement);
bool isLayout(const ProgramStatement& statement);
std::vector<bool> reachable(const std::vector<CycleStatement>& list);
std::vector<bool> reachable(const std::vector<ProgramStatement>& list);

} // namespace dotek::ir
