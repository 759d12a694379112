// The command line: arguments, terminal, exit status.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace dotek::cli {

// Exit status of every command (docs/cli.md).
enum ExitStatus : int {
  kDone = 0,       // whatever notes and warnings were given
  kInputError = 1, // an error in the input, a refusal, a lint finding at or above --fail-on
  kUsage = 2,      // wrong arguments, or a file that cannot be read or written
  kDefect = 3,     // a defect of Dotek itself
};

// Runs one command; `arguments` without the program's name. Throws nothing.
int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

} // namespace dotek::cli
