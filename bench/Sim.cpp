// `dotek sim` on generated programs beside LinuxCNC's rs274, if it is there, and `wc -l`, which only counts
// lines.
//   bench_sim --dotek PROGRAM [--rs274 PROGRAM] [--runs N] [--blocks N] [--large MB] [--check]
// Whole processes, medians, one run of this program. --check exits with 1 where the goal is missed.
#include "bench/Process.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <string>

namespace fs = std::filesystem;
using namespace bench;

namespace {

constexpr double kGoal = 60;       // times rs274
constexpr double kMacroGoal = 150; // the same, of a macro program
constexpr std::uint64_t kPasses = 2'000'000, kMovingPasses = 20'000;

// The same numbers everywhere: no library's generator.
class Random {
public:
  std::uint32_t below(std::uint32_t n) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::uint32_t>((state_ >> 33) % n);
  }
  double between(double least, double most) { return least + (most - least) * below(1'000'001) / 1e6; }

private:
  std::uint64_t state_ = 20261121;
};

// What a CAM writes for a surface: mostly feeds, some rapids, arcs, blocks without a G code.
void writeProgram(const fs::path& path, std::uint64_t blocks, std::uint64_t bytes) {
  std::ofstream out(path, std::ios::binary);
  Random random;
  std::string text = "%\nG21 G17 G40 G49 G80 G90 G94\nG54\nT1 M6\nS8000 M3\nG0 X0. Y0. Z50.\nM8\n";
  std::uint64_t written = 0;
  double x = 0, y = 0;
  bool arc = false; // in force
  for (std::uint64_t i = 1; i <= blocks && (bytes == 0 || written < bytes); ++i) {
    const std::uint32_t kind = random.below(20);
    const std::string number = fmt::format("N{}", i % 90000 + 10);
    if (kind == 0) { // half a circle
      arc = true;
      const double radius = random.between(1, 40);
      const std::string start = fmt::format("{:.3f}", radius);
      const double r = std::atof(start.c_str());
      x += 2 * r;
      text += fmt::format("{} G{} X{:.3f} Y{:.3f} I{:.3f} J0.\n", number, 2 + random.below(2), x, y, r);
    } else {
      x = random.between(-400, 400);
      y = random.between(-400, 400);
      const double z = random.between(-50, 5);
      const char* const code = kind <= 2 ? "G0 " : kind <= 14 || arc ? "G1 " : "";
      text += fmt::format("{} {}X{:.3f} Y{:.3f} Z{:.3f}", number, code, x, y, z);
      arc = false;
      if (kind > 2 && kind <= 10) text += fmt::format(" F{}", 100 + random.below(4900));
      text += '\n';
    }
    // As text, so that an arc begins where the block before ended.
    x = std::atof(fmt::format("{:.3f}", x).c_str());
    y = std::atof(fmt::format("{:.3f}", y).c_str());
    if (text.size() > 1u << 20) {
      written += text.size();
      out << text;
      text.clear();
    }
  }
  out << text << "M9\nM5\nG0 Z50.\nM30\n%\n";
}

void row(const std::string& name, const Figures& figures, double megabytes, double base) {
  if (figures.status != 0) {
    fmt::print("| {} | exit status {}: not measured | | | |\n", name, figures.status);
    return;
  }
  fmt::print("| {} | {:.1f} | {:.0f} | {} | {:.1f} |\n", name, figures.median,
             megabytes / figures.median * 1000, base > 0 ? fmt::format("{:.1f}", base / figures.median) : "",
             figures.megabytes);
}

// A loop with two functions, as macro B and as rs274 writes it; with `moves` each pass is a feed as well.
void writeLoop(const fs::path& macro, const fs::path& words, std::uint64_t passes, bool moves) {
  const std::string before = "G21 G90 G94\n#1=0\n#2=0\n";
  const char* const move = moves ? "G1 X#1 Y[#2/1000.] F1000\n" : "";
  std::ofstream(macro, std::ios::binary)
      << fmt::format("%\nO1\n{}WHILE[#1LT{}]DO1\n#2=#2+SIN[#1]*SQRT[#1]\n{}#1=#1+1\nEND1\n#500=#2\nM30\n%\n",
                     before, passes, move);
  std::ofstream(words, std::ios::binary)
      << fmt::format("%\n{}o1 while [#1 lt {}]\n#2=[#2+sin[#1]*sqrt[#1]]\n{}#1=[#1+1]\no1 endwhile\nM2\n%\n",
                     before, passes, move);
}

std::optional<fs::path> inPath(const std::string& name) {
  const char* path = std::getenv("PATH");
  for (std::string rest = path == nullptr ? "" : path; !rest.empty();) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    const fs::path file = fs::path(rest.substr(0, colon)) / name;
    if (fs::exists(file)) return file;
    rest.erase(0, colon + 1);
  }
  return std::nullopt;
}

} // namespace

int main(int argc, char** argv) {
  std::string dotek = "build/release/dotek", rs274;
  int runs = 5;
  std::uint64_t blocks = 200'000, large = 200;
  bool check = false;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    const bool more = i + 1 < argc;
    if (flag == "--dotek" && more)
      dotek = argv[++i];
    else if (flag == "--rs274" && more)
      rs274 = argv[++i];
    else if (flag == "--runs" && more)
      runs = std::max(1, std::atoi(argv[++i]));
    else if (flag == "--blocks" && more)
      blocks = std::strtoull(argv[++i], nullptr, 10);
    else if (flag == "--large" && more)
      large = std::strtoull(argv[++i], nullptr, 10);
    else if (flag == "--check")
      check = true;
    else {
      fmt::print(
          stderr,
          "bench_sim --dotek PROGRAM [--rs274 PROGRAM] [--runs N] [--blocks N] [--large MB] [--check]\n");
      return 2;
    }
  }
  if (rs274.empty()) rs274 = inPath("rs274").value_or("").string();
  const fs::path scratch = fs::path(dotek).parent_path() / "bench";
  fs::create_directories(scratch);
  const fs::path big = scratch / "big.nc", huge = scratch / "huge.nc";
  writeProgram(big, blocks, 0);
  const double size = static_cast<double>(fs::file_size(big)) / 1e6;

  fmt::print("{} blocks, {:.1f} MB; median of {} runs, whole processes; rs274 prints to /dev/null, dotek "
             "prints nothing\n\n",
             blocks, size, runs);
  fmt::print("| work | ms | MB/s | times rs274 | MB |\n|---|---|---|---|---|\n");
  double base = 0;
  bool broken = false, missed = false;
  if (!rs274.empty()) {
    // Its own tool table and parameters, which it demands.
    std::ofstream(scratch / "rs274.tbl") << "T1 P1 Z0 D6\n";
    std::ofstream(scratch / "rs274.var");
    const Command command = {
        rs274, "-t",        (scratch / "rs274.tbl").string(), "-v", (scratch / "rs274.var").string(),
        "-g",  big.string()};
    const Figures figures = measure(command, runs);
    if (figures.status == 0) {
      base = figures.median;
      row("rs274 -g", figures, size, base);
    } else {
      fmt::print("| rs274 -g | exit status {}: not measured | | | |\n", figures.status);
    }
  } else {
    fmt::print("| rs274 -g | not installed | | | |\n");
  }
  const Figures quiet = measure({dotek, "sim", big.string(), "--quiet"}, runs);
  row("dotek sim --quiet", quiet, size, base);
  const Figures traced = measure({dotek, "sim", big.string()}, runs);
  row("dotek sim, trace to /dev/null", traced, size, base);
  row("wc -l", measure({"/usr/bin/wc", "-l", big.string()}, runs), size, base);
  row("dotek list limits (starts and ends)", measure({dotek, "list", "limits"}, runs), 0, 0);
  broken = quiet.status != 0 || traced.status != 0;
  missed = base > 0 && base / quiet.median < kGoal;
  if (large > 0) {
    writeProgram(huge, UINT64_MAX, large * 1'000'000);
    const double hugeSize = static_cast<double>(fs::file_size(huge)) / 1e6;
    const Figures figures = measure({dotek, "sim", huge.string(), "--quiet"}, 1);
    row(fmt::format("dotek sim --quiet, {:.0f} MB", hugeSize), figures, hugeSize, 0);
    broken = broken || figures.status != 0;
    // Constant memory: not more than the small program takes, but for noise.
    missed = missed || figures.megabytes > quiet.megabytes + 2;
    fs::remove(huge);
  }

  // Macro programs: computing, then moving, both with what each prints of it.
  fmt::print("\n| work | ms | times rs274 | MB |\n|---|---|---|---|\n");
  const fs::path macro = scratch / "loop.nc", words = scratch / "loop.ngc";
  const auto loopRow = [](const std::string& name, const Figures& figures, double reference) {
    if (figures.status != 0)
      fmt::print("| {} | exit status {}: not measured | | |\n", name, figures.status);
    else
      fmt::print("| {} | {:.1f} | {} | {:.1f} |\n", name, figures.median,
                 reference > 0 ? fmt::format("{:.1f}", reference / figures.median) : "", figures.megabytes);
    return figures.status == 0;
  };
  for (const bool moves : {false, true}) {
    const std::uint64_t passes = moves ? kMovingPasses : kPasses;
    writeLoop(macro, words, passes, moves);
    const std::string what = fmt::format("{} passes{}", passes, moves ? " with a move, printed" : "");
    double loopBase = 0;
    if (!rs274.empty()) {
      const Figures figures = measure({rs274, "-t", (scratch / "rs274.tbl").string(), "-v",
                                       (scratch / "rs274.var").string(), "-g", words.string()},
                                      moves ? runs : 1);
      if (loopRow("rs274 -g, " + what, figures, 0)) loopBase = figures.median;
    }
    for (const char* control : {"fanuc-31i-b", "fanuc-0i-md"}) {
      Command command = {dotek, "sim", macro.string(), "--control", control};
      if (!moves) command.push_back("--quiet");
      const Figures figures = measure(command, runs);
      broken =
          !loopRow(fmt::format("dotek sim --control {}, {}", control, what), figures, loopBase) || broken;
      if (!moves && std::string(control) == "fanuc-31i-b")
        missed = missed || (loopBase > 0 && loopBase / figures.median < kMacroGoal);
    }
  }
  if (missed)
    fmt::print(
        "\nMISSED: {} times rs274 is the goal, {} for macro programs, and the memory of the small program\n",
        kGoal, kMacroGoal);
  return broken || (check && missed) ? 1 : 0;
}
