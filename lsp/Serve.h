// `dotek lsp`: a server of the language server protocol on standard input and output.
#pragma once

#include <iosfwd>
#include <string>

namespace dotek::lsp {

// Serves until the editor ends; the status of the process: 0 after `shutdown` and `exit`, 1 where the editor
// ends without them, 2 where the output fails or what comes is no message; `err` gets a line for that. A
// reader that is gone is the end, too. `scriptProgram`: runs scripts, as in CommonOptions.
int serve(int input, int output, const std::string& scriptProgram, std::ostream& err);

} // namespace dotek::lsp
