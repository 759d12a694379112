// How work grows with the input: each construct at sizes n, 2n, 4n, 8n; the exponent of the growth.
//   bench_growth --dotek PROGRAM [--only TEXT] [--count processor|valgrind|screen|time] [--scale X] [--list]
//   [--check]
// screen: what grows in proportion by its processor time is done with, valgrind counts the others.
// --check exits with 1 where an exponent is above 1.3 or a run fails; --scale makes all sizes X times as
// large.
#include "bench/Constructs.h"
#include "bench/Work.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>

namespace fs = std::filesystem;
using namespace bench;

namespace {

constexpr double kMost = 1.3;     // exponent
constexpr double kEnded = 0.8;    // of the work of half the size
constexpr int kAgain = 2;         // times that memory is measured anew where it seems steep
constexpr int kSecondsOfRun = 60; // of processor time
// By processor time, which varies: below this nothing above kMost hides. Work at n that has grown by 1.3
// would have to be measured as 1.4 times of what it is, in the fastest of three runs, and work at 8n not.
constexpr double kClear = 1.15;

struct Arguments {
  std::string dotek = "build/release/dotek";
  std::string only;
  std::optional<Counter> counter;
  bool screen = false;
  double scale = 1;
  bool list = false;
  bool check = false;
};

std::optional<Arguments> read(int argc, char** argv) {
  Arguments out;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    const bool more = i + 1 < argc;
    if (flag == "--list")
      out.list = true;
    else if (flag == "--check")
      out.check = true;
    else if (!more)
      return std::nullopt;
    else if (flag == "--dotek")
      out.dotek = argv[++i];
    else if (flag == "--only")
      out.only = argv[++i];
    else if (flag == "--scale")
      out.scale = std::atof(argv[++i]);
    else if (flag == "--count") {
      const std::string what = argv[++i];
      if (what == "processor")
        out.counter = Counter::Instructions;
      else if (what == "valgrind")
        out.counter = Counter::Valgrind;
      else if (what == "time")
        out.counter = Counter::Time;
      else if (what == "screen")
        out.screen = true;
      else
        return std::nullopt;
    } else
      return std::nullopt;
  }
  if (out.scale <= 0) return std::nullopt;
  return out;
}

std::vector<Construct> allConstructs() {
  std::vector<Construct> out;
  addMacroB(out);
  addGibbs(out);
  addComPost(out);
  addMikroprog(out);
  addCycle(out);
  addData(out);
  addTargets(out);
  return out;
}

Work measure(const Construct& construct, long size, const std::string& dotek, const fs::path& scratch,
             Counter counter) {
  fs::remove_all(scratch);
  fs::create_directories(scratch);
  const Input input = construct.make(size);
  for (const auto& [file, text] : input.files) {
    const fs::path path = scratch / file;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }
  Command command = {dotek};
  command.insert(command.end(), input.arguments.begin(), input.arguments.end());
  return workOf(command, scratch.string(), counter, kSecondsOfRun);
}

struct Growth {
  std::array<Work, 4> work;
  double exponent = 0; // of the whole range or of the last doubling, whichever is larger
  double memory = 0;   // as `exponent`, of the resident set; 0 where it hardly grows
  bool failed = false;
};

// What is above the cost of a run that does next to nothing, which noise must not make 0.
double above(double amount, double base) {
  return std::max(amount - base, base / 20);
}

// Of all of the growth or of the last doubling, whichever is steeper. A run that does less than a smaller one
// came to a limit: the growth ends before it.
double exponentOfWork(const std::array<Work, 4>& work, double base) {
  std::size_t last = 1;
  while (last + 1 < work.size() && work[last + 1].amount >= kEnded * work[last].amount)
    ++last;
  const double most = above(work[last].amount, base);
  return std::max(std::log2(most / above(work[0].amount, base)) / static_cast<double>(last),
                  std::log2(most / above(work[last - 1].amount, base)));
}

// Memory comes in steps, and what a run has freed is used first: steep is what is steep over all of the
// growth and in the last doubling, and only where it exceeds the size of a run without input.
double exponentOfMemory(const std::array<Work, 4>& work, double base) {
  if (work[3].megabytes < 2 * base) return 0;
  const double last = above(work[3].megabytes, base);
  return std::min(std::log2(last / above(work[0].megabytes, base)) / 3,
                  std::log2(last / above(work[2].megabytes, base)));
}

Growth grow(const Construct& construct, double scale, const std::string& dotek, const fs::path& scratch,
            Counter counter) {
  Growth out;
  const long size = std::max(1L, std::lround(static_cast<double>(construct.size) * scale));
  const Work base = measure(construct, 1, dotek, scratch, counter);
  for (std::size_t i = 0; i < out.work.size(); ++i) {
    out.work[i] = measure(construct, size << i, dotek, scratch, counter);
    out.failed = out.failed || out.work[i].status < 0 || out.work[i].status > 2;
    if (out.work[i].status < 0) return out; // the larger ones would not end either
  }
  out.exponent = exponentOfWork(out.work, base.amount);
  out.memory = exponentOfMemory(out.work, base.megabytes);
  // How many pages a process holds at once varies with what the machine does besides: the least counts.
  for (int again = 0; again < kAgain && out.memory > kMost; ++again) {
    for (std::size_t i = 0; i < out.work.size(); ++i)
      out.work[i].megabytes = std::min(
          out.work[i].megabytes, measure(construct, size << i, dotek, scratch, Counter::Time).megabytes);
    out.memory = exponentOfMemory(out.work, base.megabytes);
  }
  return out;
}

} // namespace

int main(int argc, char** argv) {
  const std::optional<Arguments> arguments = read(argc, argv);
  if (!arguments) {
    fmt::print(
        stderr,
        "bench_growth --dotek PROGRAM [--only TEXT] [--count processor|valgrind|screen|time] [--scale X] "
        "[--list] [--check]\n");
    return 2;
  }
  const std::string dotek = fs::absolute(arguments->dotek).string();
  const fs::path scratch = fs::path(dotek).parent_path() / "bench" / "growth";
  const Counter best = bestCounter();
  if (arguments->counter == Counter::Instructions && best != Counter::Instructions) {
    fmt::print(stderr,
               "bench_growth: this machine does not let a process count its instructions; use --count "
               "valgrind or --count time\n");
    return 2;
  }
  const Counter counter = arguments->screen ? Counter::Time : arguments->counter.value_or(best);
  bool missed = false;
  if (!arguments->list) {
    fmt::print("work is {}{}\n\n", name(counter),
               arguments->screen ? "; `counted`: instructions (valgrind), in millions" : "");
    fmt::print("| construct | n | work at n, 2n, 4n, 8n (millions) | exponent | MB at 8n | exponent "
               "|\n|---|---|---|---|---|---|\n");
  }
  for (const Construct& construct : allConstructs()) {
    if (construct.name.find(arguments->only) == std::string::npos) continue;
    if (arguments->list) {
      fmt::print("{}\n", construct.name);
      continue;
    }
    Growth growth = grow(construct, arguments->scale, dotek, scratch, counter);
    const bool clear = !growth.failed && growth.exponent <= kClear;
    if (arguments->screen && !clear)
      growth = grow(construct, arguments->scale, dotek, scratch, Counter::Valgrind);
    std::string work;
    for (const Work& one : growth.work)
      work += fmt::format("{}{:.3g}", work.empty() ? "" : ", ", one.amount / 1e6);
    // What could not be computed is no proof of slow growth.
    const bool over = growth.failed || !(growth.exponent <= kMost) || !(growth.memory <= kMost);
    missed = missed || over;
    if (arguments->screen && !clear) work += ", counted";
    fmt::print("| {} | {} | {} | {:.2f} | {:.0f} | {:.2f} |{}\n", construct.name,
               std::lround(static_cast<double>(construct.size) * arguments->scale), work, growth.exponent,
               growth.work.back().megabytes, growth.memory,
               growth.failed ? fmt::format(" FAILED, status {}", growth.work.back().status)
               : over        ? " TOO STEEP"
                             : "");
    std::fflush(stdout);
  }
  fs::remove_all(scratch);
  return arguments->check && missed ? 1 : 0;
}
