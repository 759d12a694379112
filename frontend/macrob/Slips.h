// What people write who know another language, or type fast: one finding for a block that the grammar does
// not take, with what to write. Included by builder sources only.
#pragma once

#include "frontend/macrob/Tokens.h"
#include "support/Diagnostics.h"

#include <optional>
#include <string_view>
#include <vector>

namespace dotek::frontend::macrob {

// `tokens` as they are written, without the end of the block; `end`: of its text. `first`: no block is before
// it in the file.
std::optional<Diagnostic> findSlip(const std::vector<Tok>& tokens, FileId file, std::string_view source,
                                   std::uint32_t end, bool first);

} // namespace dotek::frontend::macrob
