// What several readers of a call report under one code; docs/rules explains it.
#pragma once

#include "support/Diagnostics.h"

namespace dotek::frontend::nc {

DOTEK_MESSAGE_TYPE(
    CallWithoutProgram, "call-without-program", Error,
    "the macro call names no program, or one that the post prints; which macro runs is not known; write "
    "`P` and its number",
    "")

} // namespace dotek::frontend::nc
