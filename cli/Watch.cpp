#include "cli/Watch.h"

#include "support/Printable.h"

#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <ostream>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace dotek::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds kPause(300), kSettled(60);
constexpr std::size_t kMostFiles = 100'000; // a home folder by mistake

struct Stamp {
  std::int64_t seconds = 0, nanoseconds = 0, size = -1; // -1: there is no such file
  bool operator==(const Stamp&) const = default;
};
using Stamps = std::map<std::string, Stamp>;

Stamp stampOf(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return {};
  // What is printed into the folder is no change of it.
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    if (struct stat own{};
        ::fstat(stream, &own) == 0 && own.st_dev == found.st_dev && own.st_ino == found.st_ino)
      return {};
  if (S_ISDIR(found.st_mode)) return {0, 0, 0}; // what is in it counts
  return {found.st_mtim.tv_sec, found.st_mtim.tv_nsec, found.st_size};
}

Stamps stampsOf(const std::vector<std::string>& paths, const std::set<std::string>& read) {
  Stamps out;
  for (const std::string& file : read)
    out[file] = stampOf(file);
  for (const std::string& path : paths) {
    out[path] = stampOf(path);
    std::error_code error;
    if (!fs::is_directory(path, error)) continue;
    for (auto at =
             fs::recursive_directory_iterator(path, fs::directory_options::skip_permission_denied, error);
         !error && at != fs::recursive_directory_iterator() && out.size() < kMostFiles; at.increment(error)) {
      const std::string name = at->path().filename().string();
      std::error_code kind;
      if (at->is_directory(kind)) {
        if (name.starts_with(".")) at.disable_recursion_pending();
        continue;
      }
      if (!name.starts_with(".")) out[at->path().string()] = stampOf(at->path().string());
    }
  }
  return out;
}

// The first that differs; "": none.
std::string changeOf(const Stamps& before, const Stamps& now) {
  for (const auto& [path, stamp] : now)
    if (const auto at = before.find(path); at == before.end() || at->second != stamp) return path;
  for (const auto& [path, stamp] : before)
    if (stamp.size >= 0 && !now.contains(path)) return path;
  return "";
}

} // namespace

int watch(const std::vector<std::string>& paths,
          const std::function<std::set<std::string>(int& status)>& once, std::ostream& out,
          std::ostream& err) {
  int status = 0;
  for (;;) {
    // Before the run: what changes during it counts.
    const Stamps before = stampsOf(paths, {});
    const std::set<std::string> read = once(status);
    Stamps known = stampsOf({}, read);
    for (const auto& [path, stamp] : before)
      known[path] = stamp;
    out.flush();
    err << fmt::format("dotek: {} watched; an interrupt (Ctrl-C) ends it\n",
                       known.size() == 1 ? "1 file is"
                                         : fmt::format("{} files and folders are", known.size()))
        << std::flush;
    if (!out) return status;
    std::string changed;
    while ((changed = changeOf(known, stampsOf(paths, read))).empty())
      std::this_thread::sleep_for(kPause);
    // An editor writes in several steps.
    for (Stamps now = stampsOf(paths, read);;) {
      std::this_thread::sleep_for(kSettled);
      Stamps next = stampsOf(paths, read);
      if (next == now) break;
      now = std::move(next);
    }
    err << fmt::format("dotek: `{}` has changed\n", printable(changed)) << std::flush;
  }
}

} // namespace dotek::cli
