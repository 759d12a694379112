// Letters that a macro does not take together.
#pragma once

#include "stdlib/MacroSet.h"

#include <string_view>

namespace dotek::stdlib {

// The rule that a call of `program` with these letters breaks, of those that name `about`, 0: of all;
// nullptr: none.
const RefusedLetters* lettersRefused(const MacroSet& set, std::uint32_t program, std::string_view letters,
                                     char about = '\0');

} // namespace dotek::stdlib
