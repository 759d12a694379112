// The quick way to read a line, four numbers at a time, for processors that can. Private to the scanner.
#pragma once

#include "ir/NcWords.h"

namespace dotek::frontend::nc {

// Whether this processor has what readLineWide takes.
bool canReadWide();

// Reads the line at `p`, of which 64 bytes and 16 after them can be read, into `words` (line aside). Returns
// the number of its bytes, line end included; 0 where the line is for another way: a comment, a mark, a long
// number, a defect.
unsigned readLineWide(const char* p, ir::NcWords& words);

} // namespace dotek::frontend::nc
