#include "support/ProgramOutput.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dotek {
namespace {

struct Pipe {
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) ends = {-1, -1};
  }
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close(std::size_t end) {
    if (ends[end] >= 0) ::close(ends[end]);
    ends[end] = -1;
  }
  std::array<int, 2> ends{-1, -1}; // read, write
};

int start(const std::vector<std::string>& command, const Pipe& out, const Pipe& err, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.ends[1], STDERR_FILENO);
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error =
      ::posix_spawnp(&child, command.front().c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

// Both streams to their ends, as a program that fills one waits for who reads it. false: more than `most`.
bool readBoth(Pipe& out, Pipe& err, std::size_t most, std::string& printed, std::string& complaint) {
  std::array<pollfd, 2> ready{{{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}}};
  while (ready[0].fd >= 0 || ready[1].fd >= 0) {
    if (::poll(ready.data(), ready.size(), -1) < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    for (std::size_t i = 0; i < ready.size(); ++i) {
      if (ready[i].fd < 0 || ready[i].revents == 0) continue;
      std::array<char, 65536> bytes{};
      const ssize_t count = ::read(ready[i].fd, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        ready[i].fd = -1;
        continue;
      }
      std::string& text = i == 0 ? printed : complaint;
      if (text.size() < most) text.append(bytes.data(), static_cast<std::size_t>(count));
      if (printed.size() > most) return false;
    }
  }
  return true;
}

} // namespace

std::optional<std::string> outputOfProgram(const std::vector<std::string>& command, std::size_t most,
                                           std::string& why) {
  Pipe out, err;
  if (out.ends[0] < 0 || err.ends[0] < 0) {
    why = std::strerror(errno);
    return std::nullopt;
  }
  pid_t child = 0;
  if (const int error = start(command, out, err, child); error != 0) {
    why = fmt::format("{}: {}", command.front(), std::strerror(error));
    return std::nullopt;
  }
  out.close(1);
  err.close(1);
  std::string printed, complaint;
  const bool whole = readBoth(out, err, most, printed, complaint);
  if (!whole) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!whole) {
    why = fmt::format("{} printed more than {} bytes", command.front(), most);
    return std::nullopt;
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    why = complaint.substr(0, complaint.find('\n'));
    if (why.empty()) why = fmt::format("{} failed", command.front());
    return std::nullopt;
  }
  return printed;
}

} // namespace dotek
