#include "sim/stock/StockFile.h"

#include "sim/geometry/PartFile.h"
#include "stdlib/Toml.h"
#include "support/Files.h"
#include "support/messages/Part.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace dotek::sim {

using stdlib::TomlDocument;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

constexpr double kFarthest = 20'000; // mm

double size(const TomlDocument& document, const TomlValue& value, double least, double most,
            double fallback) {
  const double out = value.number(fallback);
  if (value.isNumber() && !(out >= least && out <= most))
    document.fail(value.range(), fmt::format("{} is expected to be {} to {} mm", out, least, most));
  return out;
}

Point3 point(const TomlDocument& document, const TomlValue& value) {
  const std::vector<double> n = value.numbers();
  const bool near = std::all_of(n.begin(), n.end(), [](double one) { return std::abs(one) <= kFarthest; });
  if (n.size() == 3 && near) return {n[0], n[1], n[2]};
  if (value.isArray())
    document.fail(value.range(), fmt::format("three numbers [x, y, z] within {} mm are expected", kFarthest));
  return {};
}

void readBlock(const TomlDocument& document, const TomlTable& table, StockBlock& block) {
  const TomlValue least = table.require("min", "the corner [x, y, z] with the least coordinates");
  const TomlValue most = table.require("max", "the corner [x, y, z] with the greatest coordinates");
  const TomlValue cell = table.require("cell", "the side of a square of the grid in mm");
  block.least = point(document, least);
  block.most = point(document, most);
  block.cell = size(document, cell, 0.01, 100, 1);
  if (!least.isArray() || !most.isArray()) return;
  const Point3 side = block.most - block.least;
  if (!(side.x > 0 && side.y > 0 && side.z > 0)) {
    document.fail(most.range(), "`max` is not greater than `min` in each of X, Y and Z");
  } else if (const double cells = std::ceil(side.x / block.cell) * std::ceil(side.y / block.cell);
             cells > static_cast<double>(StockMap::kMostCells)) {
    document.fail(cell.range(),
                  fmt::format("the grid has {:.0f} squares, more than {}; write a larger `cell`", cells,
                              StockMap::kMostCells));
  }
}

StockTool readTool(const TomlDocument& document, const TomlTable& table) {
  StockTool out;
  out.number =
      static_cast<std::uint32_t>(table.require("number", "the number of the tool").integer(1, 1, 99'999'999));
  out.shape.diameter =
      size(document, table.require("diameter", "the diameter of the tool in mm"), 0.01, 1000, 1);
  const TomlValue corner = table.value("corner");
  const bool ball = table.value("ball").flag(false);
  if (ball && corner)
    document.fail(corner.range(), "`corner` and `ball` are together; a ball has half its diameter as corner");
  out.shape.corner = ball ? out.shape.radius() : size(document, corner, 0, out.shape.radius(), 0);
  if (const TomlValue length = table.value("length")) out.length = size(document, length, 0, 2000, 0);
  return out;
}

} // namespace

std::optional<StockFile> loadStock(const std::string& path, const Limits& limits, const ReadBounds& bounds,
                                   SourceMap& sources, Diagnostics& diagnostics) {
  const std::optional<FileId> id = readText(path, Encoding::Utf8, std::nullopt, limits, sources, diagnostics);
  if (!id) return std::nullopt;
  const std::optional<TomlDocument> document = TomlDocument::parse(*id, sources, diagnostics);
  if (!document) return std::nullopt;
  StockFile out;
  const TomlTable root = document->root();
  if (const TomlValue block = root.require("stock", "a table [stock]"))
    readBlock(*document, block.table(), out.block);
  out.tolerance = size(*document, root.value("tolerance"), 0, 10, out.tolerance);
  if (const TomlValue zero = root.value("zero")) out.zero = point(*document, zero);
  const TomlValue tools = root.require("tool", "a table [[tool]] for each tool that cuts");
  for (const TomlTable& table : tools.tables()) {
    StockTool tool = readTool(*document, table);
    if (out.find(tool.number) != nullptr)
      document->fail(table.range(), fmt::format("tool {} is there twice", tool.number));
    out.tools.push_back(tool);
  }
  const TomlValue part = root.value("part");
  const std::string partName = part.text();
  if (!document->finish()) return std::nullopt;
  if (!part) return out;
  const std::string file = (std::filesystem::path(path).parent_path() / partName).string();
  if (!bounds.allow(file)) {
    document->fail(part.range(), fmt::format("`{}` is not below {}; `--include-root` widens that", partName,
                                             bounds.text()));
    return std::nullopt;
  }
  const std::optional<PartFile> loaded = loadPart(file, limits, bounds, sources, diagnostics);
  if (!loaded) return std::nullopt;
  // The block and the part have one frame; where it is in the machine the stock says.
  out.part = loaded->part.placed({}, {});
  return out;
}

} // namespace dotek::sim
