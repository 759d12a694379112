// A cycle to the IR.
#pragma once

#include "frontend/cycle/Ast.h"
#include "frontend/cycle/Link.h"
#include "ir/Cycle.h"
#include "support/Diagnostics.h"

#include <map>
#include <optional>

namespace dotek::frontend::cycle {

struct Lowered {
  ir::Cycle cycle;
  std::map<ir::VariableId, char> letters; // that the source wishes for arguments
};

// The cycle with the cycles that it calls written in the place of their calls. Only of a linked tree without
// error nodes in which check() found no error. Lengths are mm, angles degrees, feeds mm/min; a flag is 0 or
// 1, a choice the place of its name in the list, from 1. A parameter whose default is a constant has it as
// Variable::defaultValue; one whose default is computed is optional, and the checks compute it. What the
// language has beside moves and touches are cycles by the names of ir/CycleNames.h. What the IR has no form
// for is reported at its place; nullopt then.
std::optional<Lowered> lower(const File& file, const SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek::frontend::cycle
