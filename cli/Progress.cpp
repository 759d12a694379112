#include "cli/Progress.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace dotek::cli {
namespace {

constexpr std::chrono::milliseconds kFirst(1000), kNext(250);

bool canErase(int descriptor) {
  const char* const terminal = std::getenv("TERM");
  return isatty(descriptor) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

// A line that wraps could not be erased.
std::string fitted(std::string line) {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1)
    line.resize(std::min<std::size_t>(line.size(), size.ws_col - 1U));
  return line;
}

void print(std::string_view text) {
  // A terminal that is gone takes nothing.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

} // namespace

Progress::Progress(std::string_view command, bool wanted) : command_(command) {
  if (!wanted || !canErase(STDERR_FILENO)) return;
  // Signals are for the command's own thread.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error&) {
    // Without a thread there is no line.
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void Progress::say(std::string text) {
  const std::lock_guard lock(mutex_);
  text_ = std::move(text);
}

void Progress::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Progress::run() {
  const auto begun = std::chrono::steady_clock::now();
  std::string shown;
  std::unique_lock lock(mutex_);
  for (auto pause = kFirst; !wake_.wait_for(lock, pause, [&] { return ended_; }); pause = kNext) {
    const auto seconds =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begun).count();
    std::string line =
        fitted(fmt::format("dotek {}: {}{}{} s", command_, text_, text_.empty() ? "" : ", ", seconds));
    if (line == shown) continue;
    print("\r" + line + "\x1b[K");
    shown = std::move(line);
  }
  if (!shown.empty()) print("\r\x1b[K");
}

} // namespace dotek::cli
