// A file cut into blocks, before any of them is read: ends of blocks, comments, `%`, program headers, text of
// drawings. Both readers of blocks start from here.
#pragma once

#include "frontend/macrob/Ast.h"
#include "frontend/macrob/Parse.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::frontend::macrob {

struct Line {
  SourceRange range;             // without blanks around it
  std::uint32_t end = 0;         // after its end of block
  std::vector<Comment> comments; // places not set
  std::optional<ProgramName> header;
  bool reported = false; // an error was reported: the block counts as repaired
  SourceRange dropped;   // limits cut it: nothing is read of it; empty: whole
  SourceRange legend;    // what a listing leaves out as text of a drawing; empty: nothing
};

struct Lines {
  std::vector<Line> lines; // those that hold something
  bool markFirst = false;
  bool markLast = false;
  SourceRange leader;
  std::vector<SourceRange> legends;
  std::vector<SourceRange> stretches; // of which lines are left out
  LeftOut leftOut;
  // The file's bytes with headers, `%`, legends, open comments and whatever else is no block made blank;
  // places are those of the file. A block broken over two lines is on one.
  std::string bytes;
};

// Of a `text` that is no listing, texts of drawings are found (Line::legend) and left where they are.
Lines splitLines(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics,
                 Text text, Keep keep = Keep::All);

} // namespace dotek::frontend::macrob
