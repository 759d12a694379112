// Which refusals of a lowering hold of what is written, whatever the target and the values are.
#pragma once

#include "support/Diagnostics.h"

namespace dotek::project {

// Moves those findings of `from` into `into`. `formNamed`: somebody says that the Prog is read through its
// own form, so that what the form lacks is a finding, too.
void keepCertain(const Diagnostics& from, bool formNamed, Diagnostics& into);

} // namespace dotek::project
