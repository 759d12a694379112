// What a run of a fragment has written and said.
#pragma once

#include "backends/fusion/Run.h"
#include "project/Session.h"
#include "support/Source.h"
#include "targets/Subject.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dotek::targets {

// Lines without the numbers of writeBlock, and whether each had one.
struct Written {
  std::string text;
  std::vector<std::string> lines;
  std::vector<bool> numbered;
};
Written writtenOf(const std::string& text);

// Of a posted line: nothing but a comment; an N number before its words.
bool isComment(const std::string& line);
bool hasNumber(const std::string& posted);

// Without a line, or one after the end, the last one that holds something.
SourceRange rangeOfLine(const SourceFile& file, FileId id, std::uint32_t line);

// What keeps the translation from being run; `line` of its text, 0 where that is not known.
void reportFault(const script::Fault& fault, std::uint32_t line, const Translation& translation,
                 Session& session);

// As the fragment itself warns.
bool losesDigits(const backends::fusion::RunResult& result);
// "it stops with `..`".
std::string didInstead(const backends::fusion::RunResult& result);

} // namespace dotek::targets
