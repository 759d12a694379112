// Text of a file of programs to its syntax tree.
#pragma once

#include "frontend/macrob/Ast.h"
#include "frontend/macrob/Forms.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <cstdint>
#include <string>

namespace dotek::frontend::macrob {

// Which reader takes the plain NC blocks. Both give the same tree and findings; tests compare.
enum class Reader : std::uint8_t { Fast, GrammarOnly };

// What the file holds: a program of a machine, or the print of one (`--from listing`), of which texts of
// drawings are left out and mixed-up signs are repaired.
enum class Text : std::uint8_t { Program, Listing };

// Parses one file of the map. Never fails: problems go to `diagnostics`, at most one error a block; blocks
// that cannot be read become `Unread`. A misprint with one certain repair is reported with it, and the tree
// is that of the repaired block. An error of a block that a listing would be read without has a note.
// `forms`: of the control, where one is named. A file of which more than `kept-bytes` would be kept is one
// error, and File::tooLarge.
File parse(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics,
           Text text = Text::Program, Reader reader = Reader::Fast, Forms forms = {}, Keep keep = Keep::All);

// `dump --stage tokens`: one token a line: line:column, kind, text.
std::string dumpTokens(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics,
                       Text text = Text::Program);

// `dump --stage ast`: an indented tree, one node a line; with places unless told otherwise.
std::string dumpAst(const File& file, const SourceMap& sources, bool places = true);

} // namespace dotek::frontend::macrob
