// Which lines of two texts are the same ones: a longest common subsequence.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace dotek {

// Pairs of lines from 0, of the first and of the second text, in order. `equal(i, j)` says whether line `i`
// of the first is line `j` of the second. nullopt: the texts are too long for the table that it takes.
template <class Equal>
std::optional<std::vector<std::pair<std::uint32_t, std::uint32_t>>>
matchLines(std::uint32_t rows, std::uint32_t columns, const Equal& equal) {
  constexpr std::uint64_t kMostCells = 25'000'000;
  if (std::uint64_t{rows} * columns > kMostCells) return std::nullopt;
  const std::size_t width = std::size_t{columns} + 1;
  std::vector<std::uint32_t> common((std::size_t{rows} + 1) * width, 0); // of what is left of both
  const auto at = [&](std::uint32_t r, std::uint32_t c) -> std::uint32_t& { return common[r * width + c]; };
  for (std::uint32_t r = rows; r-- > 0;)
    for (std::uint32_t c = columns; c-- > 0;)
      at(r, c) = equal(r, c) ? at(r + 1, c + 1) + 1 : std::max(at(r + 1, c), at(r, c + 1));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
  for (std::uint32_t r = 0, c = 0; r < rows && c < columns;) {
    if (equal(r, c))
      out.emplace_back(r++, c++);
    else if (at(r + 1, c) >= at(r, c + 1))
      ++r;
    else
      ++c;
  }
  return out;
}

} // namespace dotek
