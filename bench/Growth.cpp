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
constexpr double kFarther = 5.5;  // as many times the sizes, where memory seems steep
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
  addFusion(out);
  addCycle(out);
  addData(out);
  addTargets(out);
  return out;
}

// Writes what the construct needs at `size`, and says what to run.
Command prepare(const Construct& construct, long size, const std::string& dotek, const fs::path& scratch) {
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
  return command;
}

Work measure(const Construct& construct, long size, const std::string& dotek, const fs::path& scratch,
             Counter counter) {
  const Command command = prepare(construct, size, dotek, scratch);
  Work out = workOf(command, scratch.string(), counter, kSecondsOfRun);
  if (out.status >= 0) out.heap = heapOf(command, scratch.string(), kSecondsOfRun);
  return out;
}

using Amounts = std::array<double, 4>; // at n, 2n, 4n, 8n

struct Growth {
  std::array<Work, 4> work;
  double exponent = 0; // of the whole range or of the last doubling, whichever is larger
  double memory = 0;   // as `exponent`, of the heap; 0 where it hardly grows
  bool failed = false;
};

// What is above the cost of a run that does next to nothing, which noise must not make 0.
double above(double amount, double base) {
  return std::max(amount - base, base / 20);
}

// Of all of the growth or of the last doubling, whichever is steeper. A run that does less than a smaller one
// came to a limit: the growth ends before it.
double exponentOf(const Amounts& amounts, double base) {
  std::size_t last = 1;
  while (last + 1 < amounts.size() && amounts[last + 1] >= kEnded * amounts[last])
    ++last;
  const double most = above(amounts[last], base);
  return std::max(std::log2(most / above(amounts[0], base)) / static_cast<double>(last),
                  std::log2(most / above(amounts[last - 1], base)));
}

// Only where it exceeds what a run without input takes.
double exponentOfHeap(const Amounts& heap, double base) {
  return heap[3] < 2 * base ? 0 : exponentOf(heap, base);
}

Growth grow(const Construct& construct, double scale, const std::string& dotek, const fs::path& scratch,
            Counter counter) {
  Growth out;
  const double size = static_cast<double>(construct.size) * scale;
  const auto sizeAt = [size](std::size_t i, double times) {
    return std::max(1L, std::lround(size * times)) << i;
  };
  const Work base = measure(construct, 1, dotek, scratch, counter);
  Amounts work{};
  Amounts heap{};
  for (std::size_t i = 0; i < out.work.size(); ++i) {
    out.work[i] = measure(construct, sizeAt(i, 1), dotek, scratch, counter);
    out.failed = out.failed || out.work[i].status < 0 || out.work[i].status > 2;
    if (out.work[i].status < 0) return out; // the larger ones would not end either
    work[i] = out.work[i].amount;
    heap[i] = out.work[i].heap;
  }
  out.exponent = exponentOf(work, base.amount);
  out.memory = exponentOfHeap(heap, base.heap);
  // An array doubles when it is full, and what a table took while it was read is used first: steps at one
  // size. What grows too fast does so farther on as well, in the last doubling.
  if (out.memory > kMost) {
    for (std::size_t i = 0; i < 2; ++i)
      heap[i] = heapOf(prepare(construct, sizeAt(i + 2, kFarther), dotek, scratch), scratch.string(),
                       kSecondsOfRun);
    out.memory = std::min(out.memory, std::log2(above(heap[1], base.heap) / above(heap[0], base.heap)));
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
    fmt::print(
        "| construct | n | work at n, 2n, 4n, 8n (millions) | exponent | MB at 8n | exponent of the heap "
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
    bool counted = arguments->screen && !clear && !growth.failed;
    if (counted) {
      // What runs a script does not run under valgrind; its time counts, where there is enough of it.
      Growth exact = grow(construct, arguments->scale, dotek, scratch, Counter::Valgrind);
      counted = !exact.failed;
      if (counted) growth = exact;
      if (!counted && growth.exponent > kMost)
        growth = grow(construct, arguments->scale * kFarther, dotek, scratch, Counter::Time);
    }
    std::string work;
    for (const Work& one : growth.work)
      work += fmt::format("{}{:.3g}", work.empty() ? "" : ", ", one.amount / 1e6);
    // What could not be computed is no proof of slow growth.
    const bool over = growth.failed || !(growth.exponent <= kMost) || !(growth.memory <= kMost);
    missed = missed || over;
    if (counted) work += ", counted";
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
