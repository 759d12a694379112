// Text of an editor that comes by standard input under the name of a file.
#pragma once

#include "cli/Arguments.h"
#include "support/Diagnostics.h"

namespace dotek::cli {

// With --stdin-filename: `-` becomes an input of that name, whose text is standard input, whatever the file
// of that name holds. false: it cannot be read; reported.
bool takeStandardInput(Arguments& arguments, Diagnostics& diagnostics);

} // namespace dotek::cli
