// What two runs leave, compared; private to Compare.cpp.
#pragma once

#include "verify/Compare.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::verify {

// "G54", "G54.1 P3" of a key of Record::zeros.
std::string systemName(std::uint32_t system);

// Protected moves called for where the machine is: the letters where both call the same macros, else the
// feed.
std::vector<Difference> compareIdleMoves(const Record& source, const Record& target,
                                         const CompareRules& rules);
// The first offset that the two wrote differently before they had made more than so many pieces.
std::optional<Difference> earlierOffset(const Record& source, const Record& target, const CompareRules& rules,
                                        std::size_t sourcePieces, std::size_t targetPieces);
// Work offsets, tool offsets and variables: each that differs, at most kMostOfAspect.
std::vector<Difference> compareValues(const Record& source, const Record& target, const CompareRules& rules);
// The modal groups in force at the end.
std::vector<Difference> compareModes(const Record& source, const Record& target, const CompareRules& rules);

} // namespace dotek::verify
