// The text form of one statement. Private to the printers of cycles and programs.
#pragma once

#include "ir/Names.h"
#include "ir/Statement.h"

#include <string>

namespace dotek::ir {

std::string statementText(const CycleStatement& statement, const Names& names);
std::string statementText(const ProgramStatement& statement, const Names& names);

// `text` with `; file:line, reason` after it.
std::string withOrigin(std::string text, SourceRange range, const std::string& reason,
                       const SourceMap* sources);

} // namespace dotek::ir
