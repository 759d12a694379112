// Structured regions of a program, beside its jumps (DESIGN 3f): targets without GOTO build on them.
#pragma once

#include "ir/Program.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dotek::ir {

// Statements [begin, end) of the body. If: a Branch over [then, otherwise) or over both arms; Loop: a Loop
// with its LoopEnd, or a jump backward to its begin that nothing enters from outside.
struct Region {
  enum class Kind : std::uint8_t { If, Loop };
  Kind kind = Kind::If;
  std::size_t begin = 0, end = 0;
  std::size_t otherwise = 0; // of If: first statement of the other arm; `end` where there is none
};

// Why a program has no structure, and where it shows.
struct Unstructured {
  std::string reason; // "the number of this GOTO is computed"
  SourceRange range;
};

struct Structure {
  std::vector<Region> regions; // outer ones before those that they hold
  std::optional<Unstructured> refused;
};

// A computed GOTO, an N number that two blocks have and a jump names, a jump into a loop, or flow that is not
// reducible: refused, `regions` is empty then. A jump out of a loop and an Exit within one are fine.
Structure structureOf(const Program& program);

} // namespace dotek::ir
