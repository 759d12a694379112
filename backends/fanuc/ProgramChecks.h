// What of a program another control understands otherwise, and its translation where the profiles are
// certain. Private to Program*.cpp.
#pragma once

#include "backends/fanuc/Program.h"

namespace dotek::backends::fanuc {

// What the steps share.
struct ProgramContext {
  const ProgramOptions& options;
  const SourceMap& sources;
  Diagnostics& diagnostics;

  const stdlib::Control& to() const { return options.control; }
  const stdlib::Control& from() const { return options.source; }
  // The same machine: nothing is read otherwise.
  bool same() const { return to().name == from().name && to().origin == from().origin; }
};

// Numbers of variables become those of the target. Reports what it has not.
void translateVariables(ir::Program& program, const ProgramContext& context);

// G and M codes, and numbers without a point where both controls count them differently. `file`: the programs
// of which one may run under the modes of another.
void translateWords(ir::Program& program, const ir::ProgramFile& file, const ProgramContext& context);

// Functions, digits of numbers, numbers of alarms, nesting of calls: what the target's profile bounds.
void checkProgram(const ir::Program& program, const ir::ProgramFile& file, const ProgramContext& context);

} // namespace dotek::backends::fanuc
