// A file cut into blocks, before any of them is read: ends of blocks, comments, `%`, program headers, text of
// drawings. Both readers of blocks start from here.
#pragma once

#include "frontend/macrob/Ast.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::frontend::macrob {

struct Line {
  SourceRange range;             // without blanks around it
  std::uint32_t end = 0;         // behind its end of block
  std::vector<Comment> comments; // places not set
  std::optional<ProgramName> header;
  bool reported = false; // an error was reported: the block counts as repaired
  SourceRange dropped;   // limits cut it: nothing is read of it; empty: whole
};

struct Lines {
  std::vector<Line> lines; // those that hold something
  bool markFirst = false;
  bool markLast = false;
  SourceRange leader;
  std::vector<SourceRange> legends;
  // The file's bytes with headers, `%`, legends, open comments and whatever else is no block made blank;
  // places are those of the file. A block broken over two lines stands on one.
  std::string bytes;
};

Lines splitLines(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics);

// Where in `line` the text of a drawing such as `D #7 = CUTTER DIA` begins: a letter of arguments, its own
// local variable, `=`, and words. npos: nowhere.
std::size_t findLegend(std::string_view line);

// Local variable of an argument's letter (A is 1, X is 24); 0: the letter is none.
std::uint32_t argumentVariable(char letter);

} // namespace dotek::frontend::macrob
