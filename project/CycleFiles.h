// The cycles of a command: each file is read once, and a call finds the cycle of its name beside its caller.
#pragma once

#include "frontend/cycle/Ast.h"
#include "project/Session.h"

#include <deque>
#include <map>
#include <string>

namespace dotek::project {

class CycleFiles {
public:
  explicit CycleFiles(Session& session) : session_(session) {}
  CycleFiles(const CycleFiles&) = delete;
  CycleFiles& operator=(const CycleFiles&) = delete;

  // nullptr: it cannot be read; reported. A tree may hold error nodes; they were reported.
  const frontend::cycle::File* load(const std::string& path);
  // The same, and reports what is wrong with the cycle beside its syntax.
  const frontend::cycle::File* check(const std::string& path);

private:
  // The cycle `name` of a folder: `NAME.cycle` with `-` for `_`.
  const frontend::cycle::File* find(const std::string& folder, const std::string& name);

  Session& session_;
  std::deque<frontend::cycle::File> files_;
  std::map<std::string, const frontend::cycle::File*> byPath_; // nullptr: it cannot be read
};

// What `dotek new cycle` writes: a cycle that measures, checks and sets, with a comment to each part.
std::string cycleDraft(const std::string& name);

} // namespace dotek::project
