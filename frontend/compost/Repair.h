// The ends that a routine lacks: what is said of them, and which repairs are offered.
#pragma once

#include "frontend/compost/Ast.h"
#include "support/Diagnostics.h"
#include "support/Source.h"

#include <optional>
#include <vector>

namespace dotek::frontend::compost {

// Where a routine stops, as written: at its RETURN, at the next label, or with the file.
struct RoutineEnd {
  enum class At : std::uint8_t { Return, Label, EndOfFile };
  At at = At::EndOfFile;
  SourceRange range;                // the RETURN, the label, or the place after the last byte
  std::uint32_t insertionPoint = 0; // where END and RETURN would be written
};

// The findings for the IFs of `routine` that have no END, and for a RETURN that is missing. `strayEnd` is an
// END after the RETURN, before the next label: then the RETURN may be an early one, and no repair is
// offered.
std::vector<Diagnostic> reportMissingEnds(const Routine& routine, const std::vector<const If*>& openIfs,
                                          const RoutineEnd& end, std::optional<SourceRange> strayEnd,
                                          const SourceMap& sources);

} // namespace dotek::frontend::compost
