// Programs of plain blocks, written for a control of Macro B, as programs of a control by Mikronex: block for
// block, with what means the same there; all else is refused at its word. docs/mikroprog.md, "Programs".
#pragma once

#include "backends/common/EmittedLine.h"
#include "ir/Program.h"
#include "stdlib/Control.h"
#include "stdlib/MikroprogControl.h"
#include "support/Diagnostics.h"

#include <optional>
#include <string>
#include <vector>

namespace dotek::backends::mikroprog {

struct ProgramOptions {
  const stdlib::MikroprogControl& control;
  const stdlib::Control& source; // that the program is written for
  std::string name;              // of its file, for the header
};

// The first program with the subprograms that it calls. nullopt: reported, each word that has no counterpart.
std::optional<std::vector<EmittedLine>> emitProgram(const ir::ProgramFile& file,
                                                    const ProgramOptions& options, Diagnostics& diagnostics);

} // namespace dotek::backends::mikroprog
