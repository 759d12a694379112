// `dotek lsp`: a server of the language server protocol on standard input and output.
#pragma once

#include <string>

namespace dotek::lsp {

// Serves until the editor ends; the status of the process: 0 after `shutdown` and `exit`, else 1.
// `scriptProgram`: runs scripts, as in CommonOptions.
int serve(int input, int output, const std::string& scriptProgram);

} // namespace dotek::lsp
