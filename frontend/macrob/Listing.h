// Programs as books print them and text recognition reads them (`--from listing`): repairs that nobody needs
// who reads a program of a machine. Included by builder sources only.
#pragma once

#include "frontend/macrob/Tokens.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace dotek::frontend::macrob {

// Whether the program names `#n` elsewhere.
using UsesVariable = std::function<bool(std::uint32_t)>;

// Repairs the signs of one block that recognition mixes up or loses, in `tokens`: `*130` for #130, `IF #9`
// for F#9, `#54.` for 54, `643` for G43, `5=` for #5=, a bracket. `source`: of the file. Runs before
// repairMisprints().
std::vector<Diagnostic> repairListing(std::vector<Tok>& tokens, FileId file, std::string_view source,
                                      const UsesVariable& uses);

} // namespace dotek::frontend::macrob
