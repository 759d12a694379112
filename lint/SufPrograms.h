// Rules on programs of Mikroprog (.SUF).
#pragma once

#include "frontend/mikroprog/Check.h"
#include "lint/Project.h"

namespace dotek::lint {

// Calls `visit` with each block that could be read, in the order of the text.
template <class Visit> void forEachSufBlock(const Project& project, const Visit& visit) {
  for (const mikroprog::Reading* reading : project.sufPrograms)
    for (const mikroprog::Block& block : reading->blocks)
      if (!block.line->unread) visit(*reading, block);
}

// The check of a rule that looks at one program at a time.
template <void (*CheckProgram)(const mikroprog::Reading&, Report&)>
void checkSufPrograms(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms)
    CheckProgram(*reading, report);
}

// The check of a rule that commands other than lint apply, too.
template <auto Find> void reportFound(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms)
    for (const mikroprog::Finding& one : Find(*reading))
      report.at(one.range, "{}", one.text);
}

} // namespace dotek::lint
