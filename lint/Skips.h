// Bare skip moves: G31 and the variables that hold where it stopped.
#pragma once

#include "lint/Probing.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dotek::lint {

// Axes by bit: X 1, Y 2, Z 4.
using AxisSet = std::uint8_t;
AxisSet axesOf(const ir::NcBlock& block);

// One of these codes, written out, is in the block.
template <std::size_t N>
bool hasAnyCode(const ir::NcBlock& block, char address, const std::array<double, N>& codes) {
  return std::any_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
    const double* value = word.address == address ? ir::constantValue(word.value) : nullptr;
    return value != nullptr && std::find(codes.begin(), codes.end(), *value) != codes.end();
  });
}

// The block of a G31; nullptr: another statement.
const ir::NcBlock* skipOf(const ir::ProgramStatement& statement);
// The words X, Y and Z of the block, and it has one, move the machine: they are no offset, no shift, no
// centre, no dwell.
bool moves(const ir::NcBlock& block);
// A block that moves X, Y or Z by G0, G1, or by the motion in force: no skip move, no reference point, no
// dwell, no offset.
bool isPlainMove(const ir::NcBlock& block);
bool isPlainMove(const ir::ProgramStatement& statement);
// A code that chooses a work offset: G54 to G59, G54.1 P and, on a Haas, G154 P and G110 to G129.
bool choosesSystem(const ir::NcBlock& block);
// #5061 to #5063: the axis of the contact position; nothing: another variable.
std::optional<AxisSet> contactAxis(std::uint32_t variable);

// G90 and G91 before a statement. Both: paths disagree. Unknown: a computed code, or a called program.
enum class DistanceMode : std::uint8_t { AsBefore, Absolute, Incremental, Both, Unknown };
// The mode that the block states; nothing: none.
std::optional<DistanceMode> statedMode(const ir::ProgramStatement& statement);
std::vector<std::optional<DistanceMode>> distanceModes(const std::vector<ir::ProgramStatement>& body,
                                                       const ir::ProgramFlow& flow);

// G65 or M98 that is carried out here; nullptr: another statement.
const ir::Call* callOf(const ir::ProgramStatement& statement);

} // namespace dotek::lint
