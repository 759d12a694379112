// Text form of the IR: the Cycle language.
#pragma once

#include "ir/Cycle.h"
#include "ir/Program.h"

#include <string>

namespace dotek::ir {

// With `sources`, a statement ends in `; file:line` of its first range.
std::string print(const Module& module, const SourceMap* sources);
// The programs of a file, with their structure (Structure.h) or why there is none.
std::string print(const ProgramFile& file, const SourceMap* sources);
std::string print(const Expression& expression, const Cycle& cycle);
std::string print(const Condition& condition, const Cycle& cycle);

} // namespace dotek::ir
