// Text of a cycle to its syntax tree, and back.
#pragma once

#include "frontend/cycle/Ast.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <string>

namespace dotek::frontend::cycle {

// Parses one file of the map. Never fails: problems go to `diagnostics`, broken parts become error nodes.
File parse(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics);

// The file in the one layout of the language, comments and blank lines kept. Only of a tree without error
// nodes; parsing the text gives the same tree.
std::string layOut(const File& file);
// A value or a condition as the layout writes it.
std::string layOut(const Expression& expression);

// `dump --stage tokens`: one token a line: line:column, kind, text.
std::string dumpTokens(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics);
// `dump --stage ast`: an indented tree with places, stable over releases of one schema.
std::string dumpAst(const File& file, const SourceMap& sources);

} // namespace dotek::frontend::cycle
