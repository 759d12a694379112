// Whether two runs of a program go the same way through it.
#pragma once

#include "verify/Record.h"

namespace dotek::verify {

// The same blocks, as far as they show; not where they lead to. `sameText`: it is one text that ran, so that
// places in it can be compared.
bool sameWay(const Record& a, const Record& b, bool sameText = true);

// Each of its measures has met a surface, and no macro has stopped it.
bool meetsEach(const Record& record);

} // namespace dotek::verify
