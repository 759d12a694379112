// What a run of lint can see of the disk, so that a later run knows whether it would see the same.
#pragma once

#include "lint/Options.h"
#include "support/FileIdentity.h"

#include <optional>
#include <set>
#include <string>

namespace dotek::driver {

// The names and the contents of all that the inputs may name: folders with all that is below them, of a file
// what is below its folder (project::Session::bounds), the folders of --include and --data, the other files
// of the command line, and the dotek.toml of each of them or of a folder above. A file of more than
// kWholeBytes counts by its size and its times. Folders of a version control (`.git`, ...) are left out.
class LintSeen {
public:
  static constexpr std::size_t kMostEntries = 20'000;
  static constexpr std::uintmax_t kMostBytes = 256U << 20U; // of all files that count whole
  static constexpr std::uintmax_t kWholeBytes = 16U << 20U;

  // nullopt: there is more than that; `why` says so.
  static std::optional<LintSeen> of(const lint::LintOptions& options, std::string& why);
  // The name of a result that is kept, wherever it is: it does not count.
  static bool isKept(const std::string& name);

  // Of two runs that see the same, the same.
  const std::string& digest() const { return digest_; }
  // The file is among what was looked at.
  bool contains(const std::string& path) const;

private:
  std::string digest_;
  std::set<FileIdentity> files_;
};

} // namespace dotek::driver
