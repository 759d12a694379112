// Whether two runs of a program go the same way through it.
#pragma once

#include "verify/Record.h"

namespace dotek::verify {

// The same blocks, as far as they show; not where they lead to.
bool sameWay(const Record& a, const Record& b);

} // namespace dotek::verify
