// The hand-written reader of plain NC blocks: words with numbers, nothing else.
#pragma once

#include "frontend/macrob/Ast.h"

#include <optional>
#include <string_view>

namespace dotek::frontend::macrob {

// Reads the block that is in `text`, the bytes of `range`, comments being blank. nullopt: it is not
// plain, and the grammar has to read it. Comments are left to the caller.
std::optional<Block> scanBlock(std::string_view text, SourceRange range);

} // namespace dotek::frontend::macrob
