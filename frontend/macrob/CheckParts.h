// The parts of checkFile(). Private to the checks.
#pragma once

#include "frontend/macrob/Ast.h"
#include "stdlib/Control.h"
#include "support/Diagnostics.h"
#include "support/Source.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dotek::frontend::macrob {

struct CheckContext {
  const stdlib::Control* control; // nullptr: any
  const SourceMap& sources;
  Diagnostics& diagnostics;

  template <class Id, class... Args> Diagnostic& report(SourceRange range, const Args&... args) const {
    return diagnostics.report<Id>(range, args...);
  }
};

// Loops, jumps, blocks that never run.
void checkFlow(const Program& program, const CheckContext& context);
// Numbers of variables, what is written, subscripts, missing `#`.
void checkVariables(const Program& program, const CheckContext& context);
// Functions, conditions, depth of brackets, comparisons of computed values.
void checkExpressions(const Program& program, const CheckContext& context);
// Words and calls: decimal points, arguments, positions read too early.
void checkWords(const Program& program, const CheckContext& context);

// A DO with its END, as far as they belong together. Index of blocks; SIZE_MAX: it has none.
struct Loop {
  std::size_t begin = 0, end = 0;
};
// Without reporting.
std::vector<Loop> loopsOf(const Program& program);

// Alarms and messages: number, length. Of a control alone.
void checkMessages(const Program& program, const CheckContext& context);

} // namespace dotek::frontend::macrob
