// Programs in the one layout of the control: docs/mikroprog.md, "Layout".
#pragma once

#include "frontend/mikroprog/Ast.h"
#include "support/Source.h"

#include <optional>
#include <string>

namespace dotek::frontend::mikroprog {

// Line for line, LF at the end of each: one blank between words, numbers without zeros that say nothing.
// Comments keep their bytes and their lines, since some of them are data; words keep their order. To lay the
// result out again changes nothing, and it reads as the same program. nullopt: a line could not be read.
std::optional<std::string> format(const Program& program, const SourceMap& sources);

// The same words, numbers, files and comments, whatever the spelling of the numbers.
bool sameProgram(const Program& a, const Program& b);

} // namespace dotek::frontend::mikroprog
