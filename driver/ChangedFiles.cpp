#include "driver/ChangedFiles.h"

#include "support/ProgramOutput.h"
#include "support/messages/Lint.h"

#include <filesystem>

namespace dotek::driver {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostBytes = 64U << 20U;

// The folder that a path is in, or is.
std::string folderOf(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return path;
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

void addNames(const std::string& list, const std::string& root, std::set<std::string>& out) {
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find('\0', at), list.size());
    if (end > at) out.insert(nameAmongChanged(root + "/" + list.substr(at, end - at)));
    at = end + 1;
  }
}

} // namespace

std::string nameAmongChanged(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(path, error);
  return error ? path : whole.string();
}

std::optional<std::set<std::string>> changedFiles(const std::vector<std::string>& paths,
                                                  const std::string& reference, Diagnostics& diagnostics) {
  std::set<std::string> out, roots;
  const auto asked = [&](std::vector<std::string> command) {
    std::string why;
    std::optional<std::string> printed = outputOfProgram(command, kMostBytes, why);
    if (!printed) diagnostics.report<diag::ChangedSinceUnknown>({}, reference, why);
    return printed;
  };
  for (const std::string& path : paths) {
    const auto root = asked({"git", "-C", folderOf(path), "rev-parse", "--show-toplevel"});
    if (!root) return std::nullopt;
    roots.insert(root->substr(0, root->find_last_not_of('\n') + 1));
  }
  for (const std::string& root : roots) {
    const auto differ = asked({"git", "-C", root, "diff", "--name-only", "-z", "--no-renames",
                               "--no-ext-diff", "--end-of-options", reference, "--"});
    if (!differ) return std::nullopt;
    const auto unknown =
        asked({"git", "-C", root, "ls-files", "--others", "--exclude-standard", "--full-name", "-z"});
    if (!unknown) return std::nullopt;
    addNames(*differ, root, out);
    addNames(*unknown, root, out);
  }
  return out;
}

} // namespace dotek::driver
