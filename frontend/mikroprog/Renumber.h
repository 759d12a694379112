// Numbers of blocks given anew, and with them all that jumps to them.
#pragma once

#include "frontend/mikroprog/Ast.h"
#include "support/Diagnostics.h"
#include "support/Source.h"

#include <cstdint>
#include <optional>
#include <string>

namespace dotek::frontend::mikroprog {

struct Renumbering {
  std::uint64_t start = 10, step = 10;
  bool all = false; // blocks without a number, too
};

// The text with the new numbers; all other bytes stay. L follows, but for that beside a file (G28), which is
// a block of another program. nullopt: a line could not be read, or an L names no block, several blocks or a
// parameter; reported at its place.
std::optional<std::string> renumber(const Program& program, const Renumbering& how, const SourceMap& sources,
                                    Diagnostics& diagnostics);

} // namespace dotek::frontend::mikroprog
