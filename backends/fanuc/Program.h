// Writes programs of macro B for a Fanuc control: blocks in their order, with numbers and comments in place.
#pragma once

#include "backends/fanuc/Emit.h"
#include "ir/Program.h"
#include "stdlib/MacroSet.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace dotek::backends::fanuc {

struct ProgramOptions {
  const stdlib::Control& control;                                  // that the result is for
  const stdlib::Control& source;                                   // that the programs are written for
  std::optional<std::uint32_t> number;                             // of the one program of the file
  std::optional<std::pair<std::uint64_t, std::uint64_t>> renumber; // first N number and step
  bool plainMessages = false;                       // accents of messages are dropped; else they are refused
  std::vector<const stdlib::MacroSet*> macros = {}; // that the programs may call, as a vendor delivers them
};

// The file, `%` lines included; after each program's lines the next. nullopt where the control cannot say
// something, or may understand it differently than the source's: reported at its place.
std::optional<std::vector<EmittedLine>> emitPrograms(const ir::ProgramFile& file,
                                                     const ProgramOptions& options, const SourceMap& sources,
                                                     Diagnostics& diagnostics);

} // namespace dotek::backends::fanuc
