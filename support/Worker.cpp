#include "support/Worker.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/auxv.h>
#include <sys/prctl.h>
#endif

extern char** environ; // NOLINT(readability-redundant-declaration)

namespace dotek {

namespace {

using State = FrameEnd::State;
using Clock = FrameEnd::Clock;

void putSize(std::string& out, std::size_t size) {
  for (int shift = 0; shift < 32; shift += 8)
    out.push_back(static_cast<char>(size >> shift & 0xff));
}

std::uint32_t sizeAt(std::string_view bytes) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 4; ++i)
    out |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  return out;
}

// posix_spawn's two descriptions of what a child is like.
class SpawnSettings {
public:
  explicit SpawnSettings(int input) {
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

} // namespace

State FrameEnd::wait(short events, const std::optional<Clock::time_point>& deadline) const {
  for (;;) {
    int left = -1;
    if (deadline) {
      const auto time =
          std::chrono::duration_cast<std::chrono::milliseconds>(*deadline - Clock::now()).count();
      if (time <= 0) return State::Late;
      left = static_cast<int>(std::min<std::int64_t>(time, 1'000'000));
    }
    pollfd one{descriptor_, events, 0};
    const int ready = poll(&one, 1, left);
    if (ready > 0) return State::Done;
    if (ready < 0 && errno != EINTR && errno != EAGAIN) return State::Closed;
  }
}

State FrameEnd::send(std::string_view frame, std::optional<Clock::time_point> deadline) const {
  if (frame.size() > UINT32_MAX) return State::TooLong;
  std::string bytes;
  bytes.reserve(frame.size() + 4);
  putSize(bytes, frame.size());
  bytes += frame;
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t done =
        ::send(descriptor_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (done >= 0) {
      at += static_cast<std::size_t>(done);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS) {
      if (const State state = wait(POLLOUT, deadline); state != State::Done) return state;
    } else if (errno != EINTR) {
      return State::Closed;
    }
  }
  return State::Done;
}

State FrameEnd::take(char* bytes, std::size_t size, const std::optional<Clock::time_point>& deadline) const {
  while (size > 0) {
    if (const State state = wait(POLLIN, deadline); state != State::Done) return state;
    const ssize_t done = recv(descriptor_, bytes, size, MSG_DONTWAIT);
    if (done == 0) return State::Closed;
    if (done < 0) {
      if (errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK) continue;
      return State::Closed;
    }
    bytes += done;
    size -= static_cast<std::size_t>(done);
  }
  return State::Done;
}

State FrameEnd::receive(std::string& frame, std::size_t most,
                        std::optional<Clock::time_point> deadline) const {
  std::array<char, 4> head{};
  if (const State state = take(head.data(), head.size(), deadline); state != State::Done) return state;
  const std::uint32_t size = sizeAt({head.data(), head.size()});
  if (size > most) return State::TooLong;
  frame.resize(size);
  return take(frame.data(), size, deadline);
}

std::unique_ptr<Worker> Worker::start(const std::string& program, const std::vector<std::string>& arguments,
                                      std::string& why) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    why = std::strerror(errno);
    return nullptr;
  }
  std::vector<char*> words;
  words.push_back(const_cast<char*>(program.c_str()));
  for (const std::string& one : arguments)
    words.push_back(const_cast<char*>(one.c_str()));
  words.push_back(nullptr);
  pid_t process = -1;
  const SpawnSettings settings(ends[1]);
  const int failed =
      posix_spawn(&process, program.c_str(), &settings.actions, &settings.attributes, words.data(), environ);
  ::close(ends[1]);
  if (failed != 0) {
    ::close(ends[0]);
    why = std::strerror(failed);
    return nullptr;
  }
  return std::unique_ptr<Worker>(new Worker(process, ends[0]));
}

Worker::~Worker() {
  finish();
}

// Killing a process that is already ending does not change how it ended.
void Worker::finish() {
  if (process_ == -1) return;
  kill(process_, SIGKILL);
  int status = 0;
  pid_t waited = -1;
  do
    waited = waitpid(process_, &status, 0);
  while (waited < 0 && errno == EINTR);
  if (waited == process_ && WIFEXITED(status)) end_ = {End::Kind::Exit, WEXITSTATUS(status)};
  if (waited == process_ && WIFSIGNALED(status)) end_ = {End::Kind::Signal, WTERMSIG(status)};
  process_ = -1;
  ::close(descriptor_);
}

std::optional<std::string> Worker::answer(State sent, std::size_t most, Clock::time_point deadline) {
  std::string out;
  // What it said before it ended counts.
  State got = sent == State::Late ? sent : frames_.receive(out, most, deadline);
  if (got == State::Done) return out;
  finish();
  if (got == State::Late) end_ = {End::Kind::Silent, 0};
  if (got == State::TooLong) end_ = {};
  return std::nullopt;
}

std::optional<std::string> Worker::ask(std::string_view frame, std::size_t most,
                                       std::chrono::milliseconds patience) {
  if (process_ == -1) return std::nullopt;
  const Clock::time_point deadline = Clock::now() + patience;
  return answer(frames_.send(frame, deadline), most, deadline);
}

std::optional<std::string> Worker::greeting(std::size_t most, std::chrono::milliseconds patience) {
  return process_ == -1 ? std::nullopt : answer(State::Done, most, Clock::now() + patience);
}

std::string endText(const Worker::End& end) {
  switch (end.kind) {
  case Worker::End::Kind::Exit: return "exit status " + std::to_string(end.code);
  case Worker::End::Kind::Signal:
    return "signal " + std::to_string(end.code) + " (" + strsignal(end.code) + ")";
  case Worker::End::Kind::Silent: return "no answer";
  case Worker::End::Kind::Unknown: break;
  }
  return "an end that the system does not explain";
}

bool becomeWorker() {
  struct stat input {};
  if (fstat(STDIN_FILENO, &input) != 0 || !S_ISSOCK(input.st_mode)) return false;
#ifdef CLOSE_RANGE_UNSHARE
  close_range(STDERR_FILENO + 1, ~0U, 0);
#endif
#ifdef __linux__
  // Its parent's end closes its standard input; this ends it while it computes.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  return true;
}

std::string runningProgram() {
#ifdef __linux__
  constexpr const char* kSelf = "/proc/self/exe"; // also where the file has been replaced since
  if (access(kSelf, X_OK) == 0) return kSelf;
  if (const auto* path = reinterpret_cast<const char*>(getauxval(AT_EXECFN))) return path;
#endif
  return "";
}

std::string packed(const std::vector<std::string_view>& texts) {
  std::string out;
  for (const std::string_view text : texts) {
    putSize(out, text.size());
    out += text;
  }
  return out;
}

std::optional<std::vector<std::string>> unpacked(std::string_view frame) {
  std::vector<std::string> out;
  while (!frame.empty()) {
    if (frame.size() < 4) return std::nullopt;
    const std::uint32_t size = sizeAt(frame);
    frame.remove_prefix(4);
    if (size > frame.size()) return std::nullopt;
    out.emplace_back(frame.substr(0, size));
    frame.remove_prefix(size);
  }
  return out;
}

} // namespace dotek
