// Programs of `dotek lint --programs`: those that the inputs may call. They are read, and what is found in
// them is not reported.
#pragma once

#include "project/InputWalk.h"
#include "project/Session.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace dotek::driver {

class Companions {
public:
  bool walks = false; // their folders are being walked

  // Calls back for each file of the folders, as for those of the inputs.
  void walk(const std::vector<std::string>& folders, project::InputWalk& walk, project::Session& session);
  // An input by itself.
  void note(const std::string& path);
  // `read` is called with a program that is no input.
  void take(const std::string& path, project::Session& session,
            const std::function<void(const std::string&)>& read);
  // The finding is in one of them.
  bool has(const Diagnostic& finding) const;

private:
  std::set<std::string> seen_; // canonical paths
  std::set<FileId> files_;
};

} // namespace dotek::driver
