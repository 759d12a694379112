// Numbers of blocks given anew, and with them all that goes to them.
#pragma once

#include "frontend/macrob/Ast.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dotek::frontend::macrob {

struct RenumberOptions {
  std::uint64_t start = 10, step = 10;
  bool all = false; // blocks without a number, too
  // Of each program the blocks from N`first` to N`second`, as numbered before; nothing: the whole program.
  std::optional<std::pair<std::uint64_t, std::uint64_t>> range;
  std::uint64_t last = 99999; // greatest number
};

// The text with the new numbers; all other bytes stay. Followed: GOTO, P of M99 and M97, P and Q of G70 to
// G73, Q of M98, numbers that #4114 is compared with, and local variables that hold numbers for GOTO alone.
// nullopt: the file has errors, or something goes where nobody can follow, reported at its place.
std::optional<std::string> renumber(const File& file, const RenumberOptions& options,
                                    const SourceMap& sources, Diagnostics& diagnostics);

struct RenumberInput {
  const File* file = nullptr;
  RenumberOptions options;
};
// The same of several files: M99 P and Q of M98 are followed from one to another. Of two programs of one
// number a call means that of its own file.
std::vector<std::optional<std::string>> renumber(std::span<const RenumberInput> inputs,
                                                 const SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek::frontend::macrob
