// What a cycle does while it runs, for its page.
#pragma once

#include "project/CycleCatalogue.h"

namespace dotek::project {

// Alarms, settings and calls of the statements, those of called cycles included. An alarm that the arguments
// of a call rule out is left out; which those are follows from optional parameters that are not given.
void addDeeds(const frontend::cycle::File& file, CyclePage& page);

} // namespace dotek::project
