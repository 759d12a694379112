// The programs of a run: those of the file, and those of folders, which it may call.
#pragma once

#include "ir/Program.h"
#include "project/LonePrograms.h"
#include "project/Session.h"
#include "stdlib/Control.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace dotek::project {

class ProgramLibrary {
public:
  // Of `folders` the NC files, whatever their names, in the order of these; read are the programs that are
  // called, and what these call. An error in one of them is reported, and gives nullopt; one in a program
  // that nothing calls does not matter: of the file that runs a warning names it. Where a call computes its
  // number, and of the codes of the control that call programs, those that can be read are there, too, and a
  // note names those that cannot. A file without a program is refused, so programs() is never empty.
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
  const std::string& mainPath() const { return main_; }
  // Programs of the folders that have errors and that a computed call may mean, with their files.
  const std::map<std::uint64_t, std::string>& unreadable() const { return unreadable_; }
  // The main program first; of each number one. They live as long as this object.
  std::vector<const ir::Program*> programs() const;

private:
  // A file that nobody has read.
  struct Unread {
    std::string path;
    std::set<std::uint64_t> numbers; // of its programs
  };
  struct Calls {
    std::set<std::uint64_t> numbers;
    bool computed = false; // the number of one is computed
  };

  std::optional<ir::ProgramFile> loadMain(FileId main, const stdlib::Control& control, Session& session);
  void addUncalled(FileId main, const stdlib::Control& control, Session& session);
  bool addFolders(const std::vector<std::string>& folders, const stdlib::Control& control, Session& session);
  bool find(const std::string& folder, Session& session);
  bool read(Unread& file, const stdlib::Control& control, Session& session);
  Calls calls(const stdlib::Control& control) const;
  bool addCalled(const stdlib::Control& control, Session& session);
  void addPossible(const stdlib::Control& control, Session& session);
  void add(ir::Program program, bool main, Session& session);
  void add(ir::ProgramFile file, bool main, Session& session);

  std::string main_; // path
  std::vector<Unread> unread_;
  std::vector<LoneProgram> waiting_; // of files that were read; nothing has called them so far
  std::deque<ir::Program> programs_;
  std::unordered_set<std::uint64_t> numbers_; // of programs_, without 0
  std::map<std::uint64_t, std::string> unreadable_;
};

} // namespace dotek::project
