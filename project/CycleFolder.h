// A cycle folder on disk: finds and parses its four files, and the macros they call.
#pragma once

#include "frontend/gibbs/Ast.h"
#include "frontend/gibbs/Check.h"
#include "frontend/gibbs/Cycle.h"
#include "frontend/gibbs/Parse.h"
#include "frontend/gibbs/Program.h"
#include "project/IncludeGraph.h"
#include "project/Session.h"

#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace dotek::project {

// Macros and dialogs of one folder, parsed once each. Names in CALL, #INCLUDE and DIALOG are taken relative
// to the folder, then to those of --include; case does not matter, `.mac` may be left out. What is out of the
// bounds of the session is reported and not read.
class MacroLoader {
public:
  MacroLoader(Session& session, std::filesystem::path folder);
  MacroLoader(const MacroLoader&) = delete;
  MacroLoader& operator=(const MacroLoader&) = delete;

  const frontend::gibbs::Macro* macro(const std::string& name, SourceRange where);
  const frontend::gibbs::Dialog* dialog(const std::string& name, SourceRange where);
  bool hasDialog(const std::string& name) const;
  // Of the macros, as runs have compiled them under the limits of the session.
  frontend::gibbs::Programs& programs() { return programs_; }
  // Makes a tree that was parsed elsewhere known under its file's path.
  void know(const std::string& path, const frontend::gibbs::Macro& macro);
  void know(const std::string& path, const frontend::gibbs::Dialog& dialog);
  // Macros that #INCLUDE lines of `macro` bring in, deeply; a loop is reported.
  std::vector<const frontend::gibbs::Macro*> included(const frontend::gibbs::Macro& macro);

private:
  std::string folderName() const;
  std::optional<std::filesystem::path> find(const std::string& name, const std::string& suffix);
  std::optional<std::filesystem::path> search(const std::string& name, const std::string& suffix) const;
  std::optional<std::filesystem::path> searchIn(const std::filesystem::path& where,
                                                const std::filesystem::path& relative,
                                                const std::string& suffix) const;
  bool mayRead(const std::filesystem::path& path, SourceRange where);

  Session& session_;
  std::filesystem::path folder_;
  ReadBounds bounds_;
  IncludeGraph includes_;
  frontend::gibbs::Programs programs_;
  std::deque<frontend::gibbs::Macro> ownMacros_;
  std::deque<frontend::gibbs::Dialog> ownDialogs_;
  std::map<std::string, std::filesystem::path> found_;          // by name and suffix as asked for
  std::map<std::string, const frontend::gibbs::Macro*> macros_; // by keyOf(); nullptr: cannot be read
  std::map<std::string, const frontend::gibbs::Dialog*> dialogs_;
};

struct CycleFolder {
  std::string name;       // of the folder: the cycle's name
  FileId place = kNoFile; // the folder itself, for messages about files that are not there
  std::unique_ptr<frontend::gibbs::Cycle> cycle;
  std::unique_ptr<MacroLoader> loader;
  bool complete = false; // all four files are there and could be read
  // The files of the cycle, macros that they call included, as checks look at them.
  std::deque<frontend::gibbs::CheckedFile> checked;
};

// The file of a cycle's folder by its fixed name, in whatever case; nothing where there is none.
std::optional<std::filesystem::path> cycleFile(const std::filesystem::path& folder, std::string_view name);

// true: `path` is a folder that holds at least one of the four files.
bool isCycleFolder(const std::filesystem::path& path);

// true, reported: the folder holds programs, and none of the four files.
bool isFolderOfPrograms(const std::string& path, Session& session);

// Reads, parses and checks the folder. Missing and unreadable files are reported. Without `checked` what the
// files say is left to the rules of lint.
CycleFolder loadCycleFolder(const std::string& path, Session& session, bool checked = true);

} // namespace dotek::project
