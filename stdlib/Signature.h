// The signature language of the gibbs-*.toml tables: `NAME arg, arg`. Its marks are explained at the head
// of gibbs-commands.toml.
#pragma once

#include "stdlib/GibbsKeywords.h"

#include <optional>
#include <string_view>

namespace dotek::stdlib {

// Name and arguments; nullopt with `defect` in the words of messages.
std::optional<CommandSignature> parseSignature(std::string_view text, std::string& defect);

} // namespace dotek::stdlib
