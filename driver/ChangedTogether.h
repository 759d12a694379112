// Which files are judged beside changed ones.
#pragma once

#include "lint/Project.h"

#include <deque>
#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace dotek::driver {

// What a finding of a rule that looks at more than one file rests on: the files of a cycle's folder, each
// post that has a branch for the cycle, and where none has, all posts of its control and form; programs
// beside one another. `changed` are names as changedFiles() gives them, those of deleted files, too.
class ChangedTogether {
public:
  ChangedTogether(const std::deque<lint::Project>& projects, const std::set<std::string>& changed,
                  const std::function<bool(FileId)>& isChanged);

  // Whether a finding of this code in this file may come from a change in another one.
  bool covers(std::string_view code, FileId file) const;

private:
  std::set<FileId> joined_;   // files of cycles and posts
  std::set<FileId> programs_; // of NC
};

} // namespace dotek::driver
