// dotek.toml: what a project wants of the linter.
#pragma once

#include "lint/Options.h"
#include "project/Session.h"
#include "support/Diagnostics.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::lint {

// What holds for one file.
struct Config {
  std::optional<std::set<std::string>> select;
  std::set<std::string> ignore;
  std::map<std::string, std::optional<Severity>, std::less<>> severity; // nothing: off
  std::optional<FailOn> failOn;
  std::string control, form; // "": not said
  stdlib::ProbeCodes probe;  // of the machine
  bool exclude = false;      // it is not checked, unless it is named on the command line
};

// The dotek.toml of each file: the first one in its folder or above. Its sections [[lint.path]] that take the
// file change what [lint] says, the later ones last.
class Configs {
public:
  explicit Configs(dotek::project::Session& session) : session_(session) {}

  // For a file or a folder, by its path. A defect of the dotek.toml is reported. Never null.
  const Config* of(const std::string& path);

  // Patterns of [[lint.path]] that took no file, of each dotek.toml whose whole folder is in `paths`.
  void reportUnused(const std::vector<std::string>& paths);
  // That was judged for this dotek.toml.
  bool knowsUnused(FileId settings) const;

private:
  struct Pattern {
    std::string text;
    SourceRange range;
    bool taken = false; // a file
  };
  struct Section { // [[lint.path]]
    std::vector<Pattern> patterns;
    std::optional<std::set<std::string>> select;
    std::set<std::string> ignore;
    std::optional<bool> exclude;
  };
  struct File {
    Config base;
    std::vector<Section> sections;
    dotek::project::SettingsFile settings; // of all commands
  };
  std::shared_ptr<File> load(const std::string& path, const std::string& folder);
  std::shared_ptr<File> inFolder(const std::string& folder);

  dotek::project::Session& session_;
  std::map<std::string, std::shared_ptr<File>> folders_; // by absolute path
  std::map<std::string, Config> files_;                  // by path
  std::set<std::string> whole_;                          // folders of settings that were read whole
};

// Whether findings of this code are wanted, and with which severity.
bool isWanted(std::string_view code, const LintOptions& options, const Config& config);

} // namespace dotek::lint
