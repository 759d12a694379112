// Variables of programs whose probing calls become those of another set. Private to Program*.cpp.
#pragma once

#include "backends/fanuc/TranslateCall.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <optional>

namespace dotek::backends::fanuc {

// The program that the call names; nullopt: none, or it is computed. Repeats before the number are left out.
std::optional<std::uint32_t> calledProgram(const ir::Call& call, const stdlib::Control& control);

// Reads of what the source's macros leave in variables become reads of what the target's leave. `program` is
// one of `file`, whose calls are still those of the source. Reports a read whose last call is not the same on
// all paths, and what the program keeps where the target's macros work.
void translateResults(ir::Program& program, const ir::ProgramFile& file, const TranslateSettings& settings,
                      Diagnostics& diagnostics);

} // namespace dotek::backends::fanuc
