#include "bench/Process.h"

#include <algorithm>
#include <chrono>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace bench {

Run runOnce(const Command& command) {
  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);

  Run run;
  pid_t child = 0;
  const auto begin = std::chrono::steady_clock::now();
  const int failed =
      posix_spawn(&child, command.front().c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) {
    run.status = -1;
    return run;
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const auto end = std::chrono::steady_clock::now();
  run.milliseconds = std::chrono::duration<double, std::milli>(end - begin).count();
  run.megabytes = static_cast<double>(usage.ru_maxrss) / 1024.0; // Linux counts KiB
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

Figures measure(const Command& command, int runs) {
  runOnce(command); // files into the cache
  std::vector<double> times;
  Figures figures;
  for (int i = 0; i < runs; ++i) {
    const Run run = runOnce(command);
    times.push_back(run.milliseconds);
    figures.megabytes = std::max(figures.megabytes, run.megabytes);
    figures.status = run.status;
  }
  std::sort(times.begin(), times.end());
  const std::size_t half = times.size() / 2;
  figures.median = times.size() % 2 == 1 ? times[half] : (times[half - 1] + times[half]) / 2;
  return figures;
}

} // namespace bench
