// Text of a Prog to its syntax tree.
#pragma once

#include "frontend/compost/Ast.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <string>

namespace dotek::frontend::compost {

// Parses one file of the map. Never fails: problems go to `diagnostics`, broken parts become error nodes.
// An IF open at RETURN is `open-if-at-return`, placed at the IF, with a Fix that inserts END before the
// line of RETURN where that repair has one reading only; a missing RETURN likewise.
Program parse(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics);

// `dump --stage tokens`: one token a line: line:column, kind, text.
std::string dumpTokens(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics);

// `dump --stage ast`: an indented tree with places, stable over releases of one schema.
std::string dumpAst(const Program& program, const SourceMap& sources);

} // namespace dotek::frontend::compost
