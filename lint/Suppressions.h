// Comments that suppress findings, in the comment syntax of each language:
//   { dotek: ignore CODE, CODE }   ! dotek: ignore CODE   (DOTEK: IGNORE CODE)   ;dotek: ignore CODE
//   // dotek: ignore CODE
#pragma once

#include "lint/Project.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::lint {

struct Suppression {
  std::string code;  // lower case
  SourceRange range; // of the code in the comment
  std::uint32_t firstLine = 1, lastLine = 1;
  bool used = false;
};

// The directives of all comments. Unknown codes, and regions that nothing ends, are reported.
std::vector<Suppression> suppressionsOf(const Project& project, Diagnostics& diagnostics);
// Those of files of the cycle language, which no project holds.
std::vector<Suppression> suppressionsOf(const std::vector<FileId>& cycleFiles, const SourceMap& sources,
                                        Diagnostics& diagnostics);

// Takes out what is suppressed, and reports the suppressions that met nothing. `judged(code, file)`: the
// finding could have been reported there.
void applySuppressions(std::vector<Suppression>& suppressions, const SourceMap& sources,
                       Diagnostics& diagnostics,
                       const std::function<bool(std::string_view code, FileId file)>& judged);

} // namespace dotek::lint
