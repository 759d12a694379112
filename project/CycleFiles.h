// The cycles of a command: each file is read once. A call finds the cycle of its name beside its caller, else
// in the library.
#pragma once

#include "frontend/cycle/Ast.h"
#include "project/Session.h"

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace dotek::project {

class CycleFiles {
public:
  explicit CycleFiles(Session& session) : session_(session) {}
  CycleFiles(const CycleFiles&) = delete;
  CycleFiles& operator=(const CycleFiles&) = delete;

  // Only read: what it uses and calls is not looked for. nullptr: it cannot be read; reported. A tree may
  // hold error nodes; they were reported.
  const frontend::cycle::File* load(const std::string& path);
  // Linked with the cycles that it calls and the options that it uses (frontend/cycle/Link.h).
  const frontend::cycle::File* linked(const std::string& path);
  // The same, and reports what is wrong with the cycle beside its syntax.
  const frontend::cycle::File* check(const std::string& path);
  // The cycle or the options of this name in the library, linked. nullptr: there is none.
  const frontend::cycle::File* library(const std::string& name);

private:
  frontend::cycle::File* read(const std::string& path);
  frontend::cycle::File* readLibrary(const std::string& name);
  // Of the folder; nullopt: what is in the library sees the library alone.
  const frontend::cycle::File* link(frontend::cycle::File* file, const std::optional<std::string>& folder);
  const frontend::cycle::File* find(const std::optional<std::string>& folder, const std::string& name);

  Session& session_;
  std::deque<frontend::cycle::File> files_;
  std::map<std::string, frontend::cycle::File*> byPath_; // nullptr: it cannot be read
  std::map<std::string, frontend::cycle::File*> byName_; // of the library
  std::set<const frontend::cycle::File*> linked_;
};

// What `dotek new cycle` writes: a cycle that measures, checks and sets, with a comment to each part.
std::string cycleDraft(const std::string& name);

} // namespace dotek::project
