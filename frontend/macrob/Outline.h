// What is in a file of programs: for a reader, and for editors.
#pragma once

#include "frontend/macrob/Ast.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dotek::frontend::macrob {

struct OutlineCall {
  std::string code;    // "G65", "M98"
  std::string program; // "9101"; as written where it is computed: "#[..]"
  bool computed = false;
  SourceRange range;
};

struct OutlineUse {
  std::vector<SourceRange> written, read;
};

struct OutlineProgram {
  std::string name; // "O9101", ":12", "<NAME>"; "": blocks before any header
  std::string title;
  SourceRange range;                                        // of the header, or of the first block
  std::vector<std::pair<std::string, SourceRange>> numbers; // "10", of blocks
  std::vector<OutlineCall> calls;
  std::vector<std::pair<std::string, SourceRange>> jumps; // to "10", or "#1"
  std::map<std::uint32_t, OutlineUse> variables;
  std::vector<std::pair<std::string, SourceRange>> computedVariables; // "#[#1+100]"
};

std::vector<OutlineProgram> outline(const File& file, const SourceMap& sources);

} // namespace dotek::frontend::macrob
