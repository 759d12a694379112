// `--map`: which lines of a result come from where in the sources.
#pragma once

#include "support/Source.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dotek {

struct MappedLine {
  std::uint32_t line = 0;          // of the result, from 1
  std::vector<SourceRange> ranges; // empty: made up
  std::string reason;              // "" where the ranges say all
};

struct MappedResult {
  std::string name; // of the result: "O8000.nc"
  std::vector<MappedLine> lines;
};

// JSON: an array of results, each with `name` and `lines`: `line`, `sources` (file, line, column, endLine,
// endColumn), `reason`.
std::string renderLineMap(const std::vector<MappedResult>& results, const SourceMap& sources);

} // namespace dotek
