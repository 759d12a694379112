#include "support/FileIdentity.h"

#include <charconv>
#include <filesystem>
#include <set>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace dotek {

namespace fs = std::filesystem;

namespace {

std::optional<FileIdentity> identityOf(const struct stat& status) {
  if (S_ISCHR(status.st_mode)) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino, ""};
}

} // namespace

int descriptorOf(const std::string& path) {
  if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(folder)) continue;
    int number = -1;
    const char* const end = path.data() + path.size();
    const auto [at, error] = std::from_chars(path.data() + folder.size(), end, number);
    if (error == std::errc() && at == end) return number;
  }
  return -1;
}

std::optional<FileIdentity> identifyDescriptor(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return std::nullopt;
  return identityOf(status);
}

std::string followed(const std::string& path) {
  constexpr int kMostLinks = 40; // as the system follows
  fs::path at = path;
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code error;
    const fs::path to = fs::read_symlink(at, error);
    if (error) break;
    at = to.is_absolute() ? to : at.parent_path() / to;
  }
  return at.string();
}

std::optional<FileIdentity> identify(const std::string& path) {
  if (const int descriptor = descriptorOf(path); descriptor >= 0) return identifyDescriptor(descriptor);
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return identityOf(status);
  const fs::path target = followed(path);
  const fs::path folder = target.parent_path();
  if (::stat(folder.empty() ? "." : folder.c_str(), &status) != 0) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino, target.filename().string()};
}

std::vector<std::string> withoutRepeats(const std::vector<std::string>& paths) {
  std::vector<std::string> out;
  std::set<FileIdentity> seen;
  for (const std::string& path : paths) {
    // Of an input `-` is standard input.
    const auto identity = path == "-" ? identifyDescriptor(STDIN_FILENO) : identify(path);
    if (!identity || seen.insert(*identity).second) out.push_back(path);
  }
  return out;
}

} // namespace dotek
