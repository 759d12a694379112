// Calls of probing macros in programs: from the pack of one vendor to that of another.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::backends::fanuc {

// The set whose programs the file calls: the one that knows every called number that some set knows. nullptr:
// none is called, or they belong to no single set (`mixed` is a call that does not fit).
const stdlib::MacroSet* calledSet(const ir::ProgramFile& file, const std::vector<stdlib::MacroSet>& sets,
                                  const ir::ProgramStatement** mixed = nullptr);

struct CallOptions {
  const stdlib::MacroSet& wanted;
  const std::vector<stdlib::MacroSet>& sets; // all that are known
  const stdlib::Control& control;            // that the programs are written for
  std::optional<std::uint32_t> number;       // of the one program of the file, in place of its own
  std::string written = {};                  // name of the control that they become; "": `control`
};

// Calls of the file become those of `wanted`, and reads of their results follow. A file that calls `wanted`,
// or no probing macro, stays. False where something was refused: reported at its place.
bool translateCalls(ir::ProgramFile& file, const CallOptions& options, Diagnostics& diagnostics);

} // namespace dotek::backends::fanuc
