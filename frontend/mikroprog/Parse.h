// Text of a program of Mikroprog to its syntax tree. Plain word-address lines:
//
//   program : line* ;
//   line    : ('N' digits)? (assign | word*) (';' text)? ;
//   assign  : 'P' digits '=' sign? value (('+' | '-' | '*' | '/') value)* ;
//   word    : LETTER value | '@' name ;           name: up to a blank, `;` or the line's end
//   value   : sign? number | sign? 'P' digits ;
//
// Source: docs/mikroprog.md.
#pragma once

#include "frontend/mikroprog/Ast.h"
#include "frontend/mikroprog/PlainMoves.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

namespace dotek::frontend::mikroprog {

// Never fails: problems go to `diagnostics`, at most one a line; its line is `unread`. A program of which
// more than `kept-bytes` would be kept has no lines.
Program parse(FileId file, const SourceMap& sources, Diagnostics& diagnostics, const Limits& limits = {},
              const Keeping& keeping = {});

// `dump --stage tokens`: one token a line: line:column, kind, text.
std::string dumpTokens(const Program& program, const SourceMap& sources);
// `dump --stage ast`: one line of the program a line.
std::string dumpAst(const Program& program, const SourceMap& sources);

} // namespace dotek::frontend::mikroprog
