// The syntax tree as text, in one style: docs/macrob.md, "Layout".
#pragma once

#include "frontend/macrob/Ast.h"
#include "support/Source.h"

#include <optional>
#include <string>

namespace dotek::frontend::macrob {

// The whole file, LF at the end of each line. Brackets, digits and comments stay as they were written;
// blanks, and what is on which line, become those of the style. Formatting the result again changes
// nothing, and it reads as the same tree. nullopt: the file has errors or text that is no program, so that
// laying it out could lose something.
std::optional<std::string> format(const File& file, const SourceMap& sources);

// One block without its end, one expression, one condition. Brackets are added where the tree needs them.
std::string print(const Block& block);
std::string print(const Expression& expression);
std::string print(const Condition& condition);

} // namespace dotek::frontend::macrob
