// From the syntax tree to the IR.
#pragma once

#include "frontend/mikroprog/Ast.h"
#include "ir/Program.h"
#include "support/Source.h"

#include <optional>

namespace dotek::frontend::mikroprog {

// One program; each line is a block. An N number becomes a Label, an assignment a Store of the parameter's
// number, words an NcBlock, the text after `;` a Comment after them. P6 is the machine variable 6. `@NAME` is
// a word with the address '@' whose constant has the name as its digits.
//
// Jumps and calls stay words (the L of G23, G26, G27, G31): the profile of the control says which functions
// lead to a block. So no analysis of jumps sees them.
//
// nullopt where a line is unread.
std::optional<ir::ProgramFile> lower(const Program& program, const SourceMap& sources);

} // namespace dotek::frontend::mikroprog
