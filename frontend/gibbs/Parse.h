// Text of the GibbsCAM macro files to syntax trees. None of these functions fails: problems go to
// `diagnostics`, broken parts become error nodes.
#pragma once

#include "frontend/gibbs/Ast.h"
#include "stdlib/GibbsKeywords.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <string>

namespace dotek::frontend::gibbs {

struct ParseContext {
  const SourceMap& sources;
  const stdlib::GibbsKeywords& keywords;
  const Limits& limits;
  Diagnostics& diagnostics;
};

Macro parseMacro(FileId file, const ParseContext& context);
Dialog parseDialog(FileId file, const ParseContext& context);
DefineData parseDefineData(FileId file, const ParseContext& context);

// Findings within one file that need no other file: labels, FOR and NEXT, unknown commands (a warning with
// the nearest name), kinds of arguments, unverified constructs (one note per file and construct).
// `included` are the macros that #INCLUDE brings in: their labels count as the file's own.
void checkMacro(const Macro& macro, const std::vector<const Macro*>& included, const ParseContext& context);
void checkDialog(const Dialog& dialog, const ParseContext& context);
void checkDefineData(const DefineData& data, const ParseContext& context);

// `dump --stage tokens` and `--stage ast`.
std::string dumpTokens(FileId file, const ParseContext& context);
std::string dumpAst(const Macro& macro, const SourceMap& sources);
std::string dumpAst(const Dialog& dialog, const SourceMap& sources);
std::string dumpAst(const DefineData& data, const SourceMap& sources);

} // namespace dotek::frontend::gibbs
