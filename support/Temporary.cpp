#include "support/Temporary.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dotek {
namespace {

// What a signal handler reaches has to be static: the paths of the files that it removes, each owned by its
// Temporary. With more files at one time a signal leaves the rest.
std::array<std::atomic<const char*>, 1024> pending; // NOLINT
static_assert(std::atomic<const char*>::is_always_lock_free);

void remember(const char* path) {
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

// Calls only what is safe in a handler. The signal has its default action again (SA_RESETHAND) and ends the
// process when this returns.
extern "C" void removeAndEnd(int signal) {
  for (auto& slot : pending)
    if (const char* path = slot.load()) ::unlink(path);
  ::raise(signal);
}

} // namespace

void removeTemporariesOnSignals() {
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGXCPU}) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = removeAndEnd;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
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

} // namespace dotek
