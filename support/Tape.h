// What a punched tape or a serial line leaves around a program.
#pragma once

#include <string>

namespace dotek {

// Makes blanks of what a control passes over, so that all places stay: feed holes (bytes 0) before and after
// a program, the Ctrl-Z of a DOS file at its end, both after the `%` that ends it. Bytes 0 within a program
// stay what they are, a damaged copy; so do UTF-16 and texts that do not begin as NC does.
void blankTape(std::string& bytes);

} // namespace dotek
