#include "cli/Diff.h"

#include "support/Printable.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <vector>

namespace dotek::cli {
namespace {

using Lines = std::vector<std::string_view>;

Lines linesOf(std::string_view text) {
  Lines out;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    out.push_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return out;
}

constexpr std::size_t kMostCells = 4'000'000; // of the table below

} // namespace

std::string lineDiff(const std::string& name, std::string_view before, std::string_view after) {
  const Lines a = linesOf(before), b = linesOf(after);
  std::size_t first = 0, endA = a.size(), endB = b.size();
  while (first < endA && first < endB && a[first] == b[first])
    ++first;
  while (endA > first && endB > first && a[endA - 1] == b[endB - 1])
    --endA, --endB;
  const std::size_t rows = endA - first, columns = endB - first;
  if (rows == 0 && columns == 0) return "";
  // Length of what the rests have in common.
  const bool whole = (rows + 1) * (columns + 1) > kMostCells;
  std::vector<std::uint32_t> common(whole ? 0 : (rows + 1) * (columns + 1));
  const auto at = [&](std::size_t i, std::size_t j) -> std::uint32_t& {
    return common[i * (columns + 1) + j];
  };
  for (std::size_t i = whole ? 0 : rows; i-- > 0;)
    for (std::size_t j = columns; j-- > 0;)
      at(i, j) = a[first + i] == b[first + j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
  std::string out = fmt::format("--- {0}\n+++ {0}\n", printable(name));
  std::size_t i = 0, j = 0;
  while (i < rows || j < columns) {
    if (!whole && i < rows && j < columns && a[first + i] == b[first + j]) {
      ++i, ++j;
      continue;
    }
    const std::size_t fromI = i, fromJ = j;
    std::string removed, added;
    while ((i < rows || j < columns) &&
           (whole || i == rows || j == columns || a[first + i] != b[first + j])) {
      if (i < rows && (whole || j == columns || at(i + 1, j) >= at(i, j + 1)))
        removed += fmt::format("-{}\n", printable(a[first + i++]));
      else if (j < columns)
        added += fmt::format("+{}\n", printable(b[first + j++]));
      else
        removed += fmt::format("-{}\n", printable(a[first + i++]));
    }
    out += fmt::format("@@ -{},{} +{},{} @@\n{}{}", first + fromI + 1, i - fromI, first + fromJ + 1,
                       j - fromJ, removed, added);
  }
  return out;
}

} // namespace dotek::cli
