// The programs of a run: those of the file, and those of folders, which it may call.
#pragma once

#include "ir/Program.h"
#include "project/Session.h"
#include "stdlib/Control.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dotek::project {

class ProgramLibrary {
public:
  // Of `folders` each file O1234, or with the end .nc or .NC, in the order of the names. nullopt: reported.
  static std::optional<ProgramLibrary> load(FileId main, const std::vector<std::string>& folders,
                                            const stdlib::Control& control, Session& session);
  // Text of a main program that calls O`number`.
  using Caller = std::function<std::string(std::uint64_t number)>;
  // The same where the first program of the file is called by another one. nullopt: it has no number, too.
  static std::optional<ProgramLibrary> loadCalled(FileId main, const Caller& caller,
                                                  const std::vector<std::string>& folders,
                                                  const stdlib::Control& control, Session& session);
  // Further programs that can be called; of one number the first stays.
  void addCallable(ir::ProgramFile file, Session& session) { add(std::move(file), false, session); }
  // The main program first; of each number one. They live as long as this object.
  std::vector<const ir::Program*> programs() const;

private:
  bool addFolder(const std::string& folder, const stdlib::Control& control, Session& session);
  void add(ir::ProgramFile file, bool main, Session& session);

  std::string main_; // path
  std::deque<ir::Program> programs_;
};

} // namespace dotek::project
