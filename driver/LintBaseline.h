// lint --baseline and --write-baseline: which findings of a list a run has judged.
#pragma once

#include "lint/Baseline.h"
#include "project/Session.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dotek::driver {

// What a run looked at.
struct LookedAt {
  const std::vector<std::string>& paths;                        // files and folders of the command line
  std::function<bool(FileId)> file;                             // its findings are printed
  std::function<bool(const std::string& code)> rule;            // of files that are gone
  std::function<bool(const std::string& code, FileId)> ruleFor; // of a file that was read
};

// Finds by name what was read; `sources` has to stay. A file that is gone from below one of the paths was
// looked at.
lint::Baseline::Judged judgedBy(LookedAt looked, const SourceMap& sources);

// nullopt: it cannot be read, or is no baseline; reported.
std::optional<lint::Baseline> readBaseline(const std::string& path, project::Session& session);
// What a file holds that is to be written anew: nothing where there is none, where it is a pipe or a device,
// and where it is no baseline, which `said` says then. nullopt: it cannot be read; reported.
std::optional<lint::Baseline> keptBaseline(const std::string& path, project::Session& session,
                                           std::string& said);

} // namespace dotek::driver
