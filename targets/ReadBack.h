// Text of macro B that a post or a translation gives: read once more by the language's own front end.
#pragma once

#include "ir/Program.h"
#include "project/Options.h"
#include "stdlib/Control.h"
#include "support/Diagnostics.h"

#include <optional>
#include <string>

namespace dotek::targets {

// The programs of `text`, which becomes the last file of `sources`. nullopt: it cannot be read; `found` has
// an error that says why.
std::optional<ir::ProgramFile> readBack(const std::string& name, std::string text,
                                        const stdlib::Control& control, const Limits& limits,
                                        SourceMap& sources, Diagnostics& found);
// The first error of `found`.
std::string firstError(const Diagnostics& found);

} // namespace dotek::targets
