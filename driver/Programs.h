// Programs of macro B: from a file that was read to the IR.
#pragma once

#include "driver/Session.h"
#include "ir/Program.h"
#include "stdlib/Control.h"

#include <optional>

namespace dotek::driver {

// nullopt where the file cannot run on the control: reported. What matters to the writing of the programs
// alone is left to lint.
std::optional<ir::ProgramFile> loadPrograms(FileId file, const stdlib::Control& control, Session& session);

} // namespace dotek::driver
