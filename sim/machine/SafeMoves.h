// What the text of the programs says of a run before it begins.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"
#include "support/Source.h"

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace dotek::sim {

// Blocks by their file and where they begin in it.
using BlockSet = std::set<std::pair<FileId, std::uint32_t>>;

// Skip moves that go to a position and watch for the part on the way there. Such a one is followed by an IF
// that looks at the skip position (#5061 and the following), or, before anything moves, at where the machine
// is (#5001, #5041 and the following), and nothing else reads it before the next skip move; who measures
// keeps it. A move that wants a contact (SkipWants.h) is none: a quick touch whose IF alarms without one.
BlockSet safeMoves(const std::vector<const ir::Program*>& programs, const stdlib::Control& control);

// Blocks that read where a skip move has ended and ask what it came to: conditions, copies that a condition
// looks at later, and copies that are handed to a program that does.
BlockSet askingBlocks(const std::vector<const ir::Program*>& programs);

// Common variables that the programs read, and that none of them sets by a number that is written out.
std::set<std::uint32_t> neverSet(const std::vector<const ir::Program*>& programs);

// Whether the programs may write a work offset or a tool offset.
bool mayWriteOffsets(const std::vector<const ir::Program*>& programs, const stdlib::Control& control);

} // namespace dotek::sim
