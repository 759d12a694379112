// What runs again when its files change.
#pragma once

#include <functional>
#include <iosfwd>
#include <set>
#include <string>
#include <vector>

namespace dotek::cli {

// Calls `once`, which gives the names of the files that it has read, and calls it again whenever one of these
// or a file below `paths` is written, made or taken away, until a signal ends the process or `out` cannot be
// written. Says on `err` what changed. The status of the last call, whose streams are flushed.
int watch(const std::vector<std::string>& paths,
          const std::function<std::set<std::string>(int& status)>& once, std::ostream& out,
          std::ostream& err);

} // namespace dotek::cli
