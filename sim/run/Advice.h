// What a run that did not come to its end may lack, for its message.
#pragma once

#include "ir/Program.h"

#include <string>

namespace dotek::sim {

// Letters of the arguments that the program reads before it sets them, in its order: "DZS". "": none.
std::string argumentsOf(const ir::Program& program);

// What a main program lacks that is a macro nobody called: its arguments, and where it probes and no part is
// given
// (`part`) all that a run of a probing macro needs, in one flag after another. "": it is no macro.
std::string callAdvice(const ir::Program& program, bool part);

} // namespace dotek::sim
