// Reads one block: word-address text, comments, assignments of macro variables.
#pragma once

#include "frontend/nc/Block.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <optional>
#include <vector>

namespace dotek::frontend::nc {

// nullopt where the block is no NC: reported at its place (control flow statements such as IF, GOTO, WHILE,
// too: a block of a post that holds them is refused). A hole inside a comment is refused as well.
std::optional<Block> parseBlock(const std::vector<Piece>& pieces, const Limits& limits,
                                Diagnostics& diagnostics);

} // namespace dotek::frontend::nc
