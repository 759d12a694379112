#include "driver/LintSeen.h"

#include "project/SettingsPlace.h"
#include "support/Files.h"
#include "support/Sha256.h"
#include "support/WholeName.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <sys/stat.h>
#include <vector>

namespace dotek::driver {
namespace {

namespace fs = std::filesystem;

bool isVersionControl(const std::string& name) {
  return name == ".git" || name == ".hg" || name == ".svn";
}

// Writes down what it meets, in the order of names.
class Look {
public:
  Look(std::string& text, std::set<FileIdentity>& files) : text_(text), files_(files) {}

  bool tooMany() const { return entries_ > LintSeen::kMostEntries || bytes_ > LintSeen::kMostBytes; }

  void at(const std::string& path) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      entry(path);
      const fs::path folder = fs::path(wholeName(path)).parent_path();
      below(folder.string());
      settingsAbove(folder);
      return;
    }
    below(wholeName(path));
    settingsAbove(wholeName(path));
  }

private:
  void below(const std::string& folder) {
    if (!begun_.insert(folder).second) return;
    line('d', folder, "");
    std::vector<fs::path> entries;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
      entries.push_back(at->path());
      if (entries.size() > LintSeen::kMostEntries) break;
    }
    if (error) line('!', folder, error.message());
    std::sort(entries.begin(), entries.end());
    for (const fs::path& one : entries) {
      if (tooMany()) return;
      if (LintSeen::isKept(one.filename().string())) continue;
      std::error_code kind;
      if (!fs::is_directory(fs::symlink_status(one, kind)))
        entry(one.string());
      else if (!isVersionControl(one.filename().string()))
        below(one.string());
    }
  }

  void entry(const std::string& path) {
    std::error_code error;
    if (fs::is_symlink(fs::symlink_status(path, error)))
      line('l', path, fs::read_symlink(path, error).string());
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
      line('-', path, "");
    else if (S_ISDIR(status.st_mode))
      line('D', path, ""); // of a link; what is in it is looked at by its own name
    else if (!S_ISREG(status.st_mode))
      line('s', path, "");
    else {
      line('f', path, contentOf(path, status));
      if (const auto identity = identify(path)) files_.insert(*identity);
    }
  }

  std::string contentOf(const std::string& path, const struct stat& status) {
    if (static_cast<std::uintmax_t>(status.st_size) > LintSeen::kWholeBytes)
      return fmt::format("{} {}.{} {}.{} {}", status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec,
                         status.st_ctim.tv_sec, status.st_ctim.tv_nsec, status.st_ino);
    Diagnostics ignored;
    const std::optional<std::string> bytes = readBeginning(path, LintSeen::kWholeBytes + 1, ignored);
    if (!bytes) return "closed";
    bytes_ += bytes->size();
    return sha256(*bytes);
  }

  // Each folder counts up to the first that has settings: those that are made nearer later would hold.
  void settingsAbove(fs::path folder) {
    for (;;) {
      const fs::path settings = project::settingsFileIn(folder);
      if (!settings.empty()) return entry(settings.string());
      line('n', folder.string(), "");
      if (!folder.has_relative_path()) return;
      folder = folder.parent_path();
    }
  }

  void line(char kind, const std::string& path, const std::string& what) {
    ++entries_;
    text_ += fmt::format("{}{}{}{}{}{}", kind, path, '\0', what, '\0', '\n');
  }

  std::string& text_;
  std::set<FileIdentity>& files_;
  std::set<std::string> begun_; // folders
  std::size_t entries_ = 0;
  std::uintmax_t bytes_ = 0;
};

} // namespace

bool LintSeen::isKept(const std::string& name) {
  constexpr std::string_view kEnd = ".lint";
  constexpr std::size_t kDigits = 64; // of a SHA-256
  return name.size() == 1 + kDigits + kEnd.size() && name.starts_with('.') && name.ends_with(kEnd);
}

std::optional<LintSeen> LintSeen::of(const lint::LintOptions& options, std::string& why) {
  LintSeen out;
  std::string text;
  Look look(text, out.files_);
  std::vector<std::string> places = options.paths;
  places.insert(places.end(), options.common.include.begin(), options.common.include.end());
  places.insert(places.end(), options.common.data.begin(), options.common.data.end());
  for (const auto& one :
       {options.common.includeRoot, options.common.job, options.source.prog, options.baseline})
    if (one) places.push_back(*one);
  for (const std::string& place : places)
    look.at(place);
  if (look.tooMany()) {
    why = fmt::format("the inputs may name files of more than {} entries or {} MB: name a smaller folder",
                      kMostEntries, kMostBytes >> 20U);
    return std::nullopt;
  }
  out.digest_ = sha256(text);
  return out;
}

bool LintSeen::contains(const std::string& path) const {
  const auto identity = identify(path);
  return identity && files_.contains(*identity);
}

} // namespace dotek::driver
