#include "bench/Work.h"

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bench {

namespace {

// A counter of `process` and its threads that begins when it calls exec; -1 where the system refuses.
int openCounter(pid_t process) {
  perf_event_attr attributes{};
  attributes.size = sizeof attributes;
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
  attributes.disabled = 1;
  attributes.enable_on_exec = 1;
  attributes.inherit = 1;
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  return static_cast<int>(syscall(SYS_perf_event_open, &attributes, process, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

// In the child: waits for a byte (the counter is open), then becomes the program.
[[noreturn]] void becomeProgram(const Command& command, const std::string& folder, int gate, int seconds) {
  char go = 0;
  if (read(gate, &go, 1) != 1) _exit(127);
  const int nothing = open("/dev/null", O_WRONLY);
  if (nothing < 0 || dup2(nothing, STDOUT_FILENO) < 0 || dup2(nothing, STDERR_FILENO) < 0) _exit(127);
  if (chdir(folder.c_str()) != 0) _exit(127);
  const rlimit bound{static_cast<rlim_t>(seconds), static_cast<rlim_t>(seconds)};
  setrlimit(RLIMIT_CPU, &bound);
  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments.front(), arguments.data());
  _exit(127);
}

// One run; `instructions` gets the counter's value where the system allows it, else -1.
Work run(const Command& command, const std::string& folder, int seconds, bool count, double& instructions) {
  instructions = -1;
  Work work;
  work.status = -1;
  int gate[2];
  if (pipe(gate) != 0) return work;
  const pid_t child = fork();
  if (child == 0) {
    close(gate[1]);
    becomeProgram(command, folder, gate[0], seconds);
  }
  close(gate[0]);
  if (child < 0) {
    close(gate[1]);
    return work;
  }
  const int counter = count ? openCounter(child) : -1;
  const char go = 1;
  const bool started = write(gate[1], &go, 1) == 1;
  close(gate[1]);
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || !started) return work;
  const auto micro = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_usec);
  };
  work.amount = micro(usage.ru_utime) + micro(usage.ru_stime);
  work.megabytes = static_cast<double>(usage.ru_maxrss) / 1024.0; // Linux counts KiB
  if (WIFEXITED(status) && WEXITSTATUS(status) != 127) work.status = WEXITSTATUS(status);
  if (counter >= 0) {
    std::uint64_t value = 0;
    if (read(counter, &value, sizeof value) == static_cast<ssize_t>(sizeof value) && value > 0)
      instructions = static_cast<double>(value);
    close(counter);
  }
  return work;
}

Work underValgrind(const Command& command, const std::string& folder, int seconds) {
  const std::string out = (std::filesystem::path(folder) / "cachegrind.out").string();
  Command whole = {"valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=" + out};
  whole.insert(whole.end(), command.begin(), command.end());
  double unused = 0;
  Work work = run(command, folder, seconds, false, unused); // valgrind's own memory says nothing
  if (work.status < 0 || run(whole, folder, seconds * 40, false, unused).status != work.status)
    return {.status = -1};
  work.amount = 0;
  std::ifstream file(out);
  constexpr std::string_view kSummary = "summary: ";
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, kSummary.size(), kSummary) == 0)
      work.amount = std::strtod(line.c_str() + kSummary.size(), nullptr);
  }
  if (work.amount <= 0) work.status = -1;
  std::filesystem::remove(out);
  return work;
}

// Where bench_growth is, its library is.
std::string heapLibrary() {
  std::error_code none;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", none);
  const std::filesystem::path library = self.parent_path() / "libbench_heap.so";
  return std::filesystem::exists(library, none) ? library.string() : std::string();
}

} // namespace

Counter bestCounter() {
  double instructions = 0;
  run({"true"}, "/", 10, true, instructions);
  if (instructions > 0) return Counter::Instructions;
  double unused = 0;
  const Work valgrind = run({"valgrind", "--version"}, "/", 10, false, unused);
  return valgrind.status == 0 ? Counter::Valgrind : Counter::Time;
}

std::string name(Counter counter) {
  switch (counter) {
  case Counter::Instructions: return "instructions (processor)";
  case Counter::Valgrind: return "instructions (valgrind)";
  case Counter::Time: return "microseconds of processor time, least of three runs";
  }
  return {};
}

Work workOf(const Command& command, const std::string& folder, Counter counter, int seconds) {
  if (counter == Counter::Valgrind) return underValgrind(command, folder, seconds);
  double instructions = 0;
  Work work = run(command, folder, seconds, counter == Counter::Instructions, instructions);
  if (counter == Counter::Instructions) {
    work.amount = instructions;
    return work;
  }
  // A run that is long is measured well enough by itself.
  for (int again = 0; again < 2 && work.status >= 0 && work.amount < 1e6; ++again)
    work.amount = std::min(work.amount, run(command, folder, seconds, false, instructions).amount);
  return work;
}

double heapOf(const Command& command, const std::string& folder, int seconds) {
  const std::string library = heapLibrary();
  if (library.empty()) return 0;
  const std::string file = folder + ".heap"; // beside the folder: a run may read all that is in it
  Command whole = {"env", "LD_PRELOAD=" + library, "DOTEK_BENCH_HEAP=" + file};
  whole.insert(whole.end(), command.begin(), command.end());
  double unused = 0;
  run(whole, folder, seconds, false, unused);
  std::int64_t most = 0;
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(&most), sizeof most);
  std::filesystem::remove(file);
  return static_cast<double>(most);
}

} // namespace bench
