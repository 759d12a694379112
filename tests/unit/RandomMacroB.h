// Made-up files of Macro B programs: text, so that reading it is part of what they test.
#pragma once

#include <cstdint>
#include <string>

namespace dotek::tests {

// One file: the main program O1 and what it calls. The same seed gives the same text. `modern`: with what the
// 30i series adds (MOD, POW, ATAN[y,x], GOTO after THEN). Programs end, save for a few that loop or err on
// purpose.
std::string randomMacroB(std::uint32_t seed, bool modern);

} // namespace dotek::tests
