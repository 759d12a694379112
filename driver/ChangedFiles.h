// Which files a repository of git calls changed.
#pragma once

#include "support/Diagnostics.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::driver {

// Of the repositories that hold `paths`: the files that differ from `reference` (a commit, a branch, a tag)
// as they lie in the folder now, and those that git does not know yet and does not ignore; absolute, without
// links. nullopt: a path is in no repository, or git does not know the reference; reported.
std::optional<std::set<std::string>> changedFiles(const std::vector<std::string>& paths,
                                                  const std::string& reference, Diagnostics& diagnostics);

// As changedFiles() names a file.
std::string nameAmongChanged(const std::string& path);

} // namespace dotek::driver
