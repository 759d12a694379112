// The hand-written reader of the blocks that programs mostly consist of.
#pragma once

#include "frontend/macrob/Ast.h"
#include "support/Limits.h"

#include <optional>
#include <string_view>

namespace dotek::frontend::macrob {

// Reads the block that is in `text`, the bytes of `range`, comments being blank. nullopt: it has mistakes, or
// something that is rare, and the grammar has to read it. Without `macros` only words with numbers and copies
// of variables are taken. Comments are left to the caller.
std::optional<Block> scanBlock(std::string_view text, SourceRange range, const Limits& limits = {},
                               bool macros = true);

} // namespace dotek::frontend::macrob
