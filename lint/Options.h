// What lint is asked.
#pragma once

#include "project/Options.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::lint {

// From which severity on lint fails.
enum class FailOn : std::uint8_t { Note, Warning, Error, Never };

struct LintOptions {
  std::vector<std::string> paths;
  // Folders of programs that those of `paths` may call: read, and no finding in them is reported.
  std::vector<std::string> programs;
  project::CommonOptions common;
  project::SourceOptions source;
  // Codes; nothing: what dotek.toml says, else all that are on by default. "all": every code.
  std::optional<std::set<std::string>> select;
  std::set<std::string> ignore;
  std::string control;          // profile that programs are checked for; "": what dotek.toml says
  std::optional<FailOn> failOn; // nothing: what dotek.toml says, else Warning
  bool followLinks = false;     // of folders: also links that lead out of them
  bool listSkipped = false;     // the summary names each file that was skipped
  bool fix = false;             // makes the safe repairs, then says what is left
  bool force = false;           // repairs files that are write-protected, too
  // --changed-since: findings are of the files that differ from this state of a repository; "": of all.
  std::string changedSince;
  // --baseline: path of a list of findings that are passed over; nothing: none.
  std::optional<std::string> baseline;
  // The file that the result is written to, which has such a list of what is found; lint does not fail then.
  std::optional<std::string> writeBaseline;
  // Told from time to time how far it is.
  std::function<void(const std::string& text)> progress;
};

} // namespace dotek::lint
