#include "support/Temporary.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace dotek {
namespace {

// What a signal handler reaches has to be static: the paths of the files that it removes, each owned by its
// Temporary. With more files at one time a signal leaves the rest.
std::array<std::atomic<const char*>, 1024> pending; // NOLINT
static_assert(std::atomic<const char*>::is_always_lock_free);
std::atomic<bool> ending;        // NOLINT; a signal is about to end the process
std::atomic<int> holds, waiting; // NOLINT; SignalHold objects, and the signal that waits for them

void waitForEnd() {
  while (ending.load())
    ::usleep(1000);
}

void remember(const char* path) {
  waitForEnd(); // nothing is made any more
  for (auto& slot : pending) {
    const char* empty = nullptr;
    if (slot.compare_exchange_strong(empty, path)) return;
  }
}

void forget(const char* path) {
  for (auto& slot : pending) {
    const char* held = path;
    if (slot.compare_exchange_strong(held, nullptr)) return;
  }
}

// Calls only what is safe in a handler. The signal has its default action again and ends the process, where a
// handler calls this when that returns.
extern "C" void removeAndEnd(int signal) {
  ending.store(true);
  if (holds.load() > 0) {
    waiting.store(signal);
    ending.store(false);
    return;
  }
  // A folder goes when it is empty, which another thread may still be filling.
  bool filled = true;
  for (int i = 0; filled && i < 1000; ++i) {
    filled = false;
    for (auto& slot : pending)
      if (const char* path = slot.load(); path != nullptr && ::unlink(path) != 0)
        filled |= ::rmdir(path) != 0 && errno == ENOTEMPTY;
  }
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  ::sigaction(signal, &action, nullptr);
  ::raise(signal);
}

} // namespace

void removeTemporariesOnSignals() {
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGXCPU}) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = removeAndEnd;
    ::sigaction(signal, &action, nullptr);
  }
}

SignalHold::SignalHold() {
  ++holds;
  waitForEnd();
}

SignalHold::~SignalHold() {
  if (--holds > 0) return;
  if (const int signal = waiting.exchange(0); signal != 0) removeAndEnd(signal);
}

Temporary::~Temporary() {
  close();
  if (path_.empty()) return;
  ::unlink(path_.c_str());
  forget(path_.c_str());
}

int Temporary::create(const std::string& folder, unsigned mode) {
  constexpr int kTries = 16;
  folder_ = folder;
  for (int i = 0; i < kTries; ++i) {
    std::uint64_t name = 0;
    if (::getentropy(&name, sizeof name) != 0) return errno;
    path_ = fmt::format("{}/.dotek-{:016x}", folder, name);
    remember(path_.c_str()); // before the file is there, so no signal comes between
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (descriptor_ >= 0) return 0;
    const int error = errno;
    forget(path_.c_str());
    path_.clear();
    if (error != EEXIST && error != EINTR) return error;
  }
  return EEXIST;
}

int Temporary::sync() {
  // A file system that cannot sync says EINVAL.
  return ::fsync(descriptor_) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
}

int Temporary::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  return descriptor < 0 || ::close(descriptor) == 0 || errno == EINTR ? 0 : errno;
}

int Temporary::rename(const std::string& path) {
  if (::rename(path_.c_str(), path.c_str()) != 0) return errno;
  forget(path_.c_str());
  path_.clear();
  // The file is in its place: a folder that cannot be synced is no failure.
  if (const int folder = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); folder >= 0) {
    ::fsync(folder);
    ::close(folder);
  }
  return 0;
}

TemporaryFolder::~TemporaryFolder() {
  for (auto at = made_.rbegin(); at != made_.rend(); ++at) {
    if (::unlink(at->c_str()) != 0) ::rmdir(at->c_str());
    forget(at->c_str());
  }
}

const std::string& TemporaryFolder::keep(std::string path) {
  const std::string& kept = made_.emplace_back(std::move(path));
  remember(kept.c_str());
  return kept;
}

bool TemporaryFolder::create() {
  std::error_code error;
  const std::string below = std::filesystem::temp_directory_path(error).string();
  constexpr int kTries = 16;
  for (int i = 0; i < kTries && !error && path_.empty(); ++i) {
    std::uint64_t name = 0;
    if (::getentropy(&name, sizeof name) != 0) return false;
    const std::string& path = keep(fmt::format("{}/dotek-{:016x}", below, name));
    if (::mkdir(path.c_str(), 0700) == 0) {
      path_ = path;
    } else {
      forget(path.c_str());
      made_.pop_back();
    }
  }
  return !path_.empty();
}

bool TemporaryFolder::write(const std::string& name, const std::string& text) {
  if (path_.empty()) return false;
  if (const std::size_t slash = name.find('/'); slash != std::string::npos) {
    const std::string folder = path_ + "/" + name.substr(0, slash);
    if (std::find(made_.begin(), made_.end(), folder) == made_.end() &&
        ::mkdir(keep(folder).c_str(), 0700) != 0)
      return false;
  }
  std::ofstream out(keep(path_ + "/" + name), std::ios::binary);
  out << text;
  out.flush();
  return out.good();
}

} // namespace dotek
