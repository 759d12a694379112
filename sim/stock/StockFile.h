// What is cut, with which tools, and what shall come of it: the TOML file of `sim --stock`; docs/stock.md.
#pragma once

#include "sim/geometry/Part.h"
#include "sim/stock/StockMap.h"
#include "support/Diagnostics.h"
#include "support/Files.h"
#include "support/Limits.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::sim {

struct StockTool {
  std::uint32_t number = 0;
  CutterShape shape;
  std::optional<double> length; // from the gauge line; nothing: what the control has in force
};

struct StockFile {
  StockBlock block;
  Point3 zero;             // of the frame of the block and of the part, in coordinates of the machine
  Part part;               // finished, in that frame; empty: there is none
  double tolerance = 0.01; // mm: what is cut deeper into the part is reported
  std::vector<StockTool> tools;

  const StockTool* find(std::uint32_t number) const { // nullptr: none
    const auto at =
        std::find_if(tools.begin(), tools.end(), [&](const StockTool& one) { return one.number == number; });
    return at == tools.end() ? nullptr : &*at;
  }
};

// Nothing where an error was reported. The part is looked for from the folder of the file on, and read where
// `bounds` allow it.
std::optional<StockFile> loadStock(const std::string& path, const Limits& limits, const ReadBounds& bounds,
                                   SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek::sim
