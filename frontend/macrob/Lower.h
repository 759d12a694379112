// From the syntax tree of a file of programs to the IR.
#pragma once

#include "frontend/macrob/Ast.h"
#include "ir/Program.h"
#include "stdlib/Control.h"
#include "support/Diagnostics.h"
#include "support/Source.h"

#include <cstdint>
#include <optional>

namespace dotek::frontend::macrob {

// A run meets a jump without a target when it gets there; a translation is refused at once. Rules look at
// the same as a run, without the numbers that nothing goes to.
enum class LowerFor : std::uint8_t { Run, Translation, Rules };

// The programs of the file, as `control` reads them (the form of ATAN, functions, brackets). Reports and
// gives nothing where a block was not read or repaired, or where the control cannot run a statement. Words
// keep the digits as written: what a number without a point counts is the machine's business.
std::optional<ir::ProgramFile> lower(const File& file, const stdlib::Control& control,
                                     const SourceMap& sources, Diagnostics& diagnostics,
                                     LowerFor use = LowerFor::Run);

} // namespace dotek::frontend::macrob
