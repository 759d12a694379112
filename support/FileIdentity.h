// Which file a path means, whatever links and spellings lead there.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek {

// Of a file that is not there yet: its folder and its name.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  std::string name; // "" where the file is there
  auto operator<=>(const FileIdentity&) const = default;
};

// Nothing for what holds no text of its own (a terminal, /dev/null) and where the path leads nowhere. "-" is
// standard output.
std::optional<FileIdentity> identify(const std::string& path);
std::optional<FileIdentity> identifyDescriptor(int descriptor);

// N of /dev/fd/N and /proc/self/fd/N, 1 of `-` and /dev/stdout, 2 of /dev/stderr: a stream of this process,
// whose file is not replaced. -1: another path.
int descriptorOf(const std::string& path);

// The path where links of its last part lead; that may be a file that is not there, or in a loop a link
// again.
std::string followed(const std::string& path);

// Inputs without those that name the same file or folder as one before; `-` is standard input.
std::vector<std::string> withoutRepeats(const std::vector<std::string>& paths);

} // namespace dotek
