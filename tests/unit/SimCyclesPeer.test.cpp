// Canned cycles of random programs beside LinuxCNC's rs274: where each motion ends. Of G73 and G83 where each
// feed ends, since how far they go back is a setting. DOTEK_RS274 names the program (docs/testing.md).
#include "SimHarness.h"
#include "tests/Process.h"
#include "tests/Skips.h"

#include <cmath>
#include <cstdlib>
#include <random>
#include <sstream>
#include <vector>

using namespace dotek;
using tests::Simulation;

namespace {

constexpr int kBoreWithDwell = 89; // under G98 rs274 feeds to the initial level, which it does not after G85

class Holes {
public:
  explicit Holes(unsigned seed) : random_(seed) {
    cycle = std::array{81, 82, 85, 86, 89, 73, 83}[static_cast<std::size_t>(whole(0, 6))];
    const int plane = whole(0, 2);
    const std::string uv = std::array{"XY", "ZX", "YZ"}[static_cast<std::size_t>(plane)];
    const char w = "ZYX"[plane];
    text = fmt::format("G21 {} S500 M3\nG90 G0 {}{:.3f} {}{:.3f} {}{:.3f}\n",
                       std::array{"G17", "G18", "G19"}[static_cast<std::size_t>(plane)], uv[0],
                       number(-50, 50), uv[1], number(-50, 50), w, number(5, 40));
    const bool incremental = whole(0, 2) == 0;
    text += fmt::format("{} {}\n", incremental ? "G91" : "G90",
                        whole(0, 1) == 0 && cycle != kBoreWithDwell ? "G98" : "G99");
    text += fmt::format("G{} {}{:.3f} {}{:.3f} {}{:.3f} R{:.3f}", cycle, uv[0], number(-20, 20), uv[1],
                        number(-20, 20), w, incremental ? number(-20, -2) : number(-30, -1),
                        incremental ? number(-4, -1) : number(0, 4));
    if (cycle == 73 || cycle == 83) text += fmt::format(" Q{:.3f}", number(0.5, 8));
    if (cycle == 82 || cycle == 86 || cycle == 89) text += " P0.5";
    text += repeats(incremental) + " F100\n";
    for (int i = whole(0, 4); i > 0; --i) {
      const int axes = whole(1, 3);
      if ((axes & 1) != 0) text += fmt::format("{}{:.3f} ", uv[0], number(-20, 20));
      if ((axes & 2) != 0) text += fmt::format("{}{:.3f} ", uv[1], number(-20, 20));
      text += repeats(incremental) + "\n";
    }
    text += "G80\n";
  }
  bool pecks() const { return cycle == 73 || cycle == 83; }
  std::string text;
  int cycle = 0;

private:
  int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  double number(double from, double to) {
    return std::round(std::uniform_real_distribution<double>(from, to)(random_) * 1000) / 1000;
  }
  std::string repeats(bool incremental) {
    return incremental && whole(0, 2) == 0 ? fmt::format(" L{}", whole(2, 4)) : "";
  }
  std::mt19937 random_;
};

using Ends = std::vector<std::string>;
void add(Ends& ends, double x, double y, double z) {
  std::string one = fmt::format("{:.3f} {:.3f} {:.3f}", x + 0.0, y + 0.0, z + 0.0);
  if (ends.empty() || ends.back() != one) ends.push_back(std::move(one));
}

struct Motions : sim::MotionWatcher {
  bool feeds = false;
  Ends ends;
  void moved(const sim::MachineMotion& motion) override {
    if (!feeds || motion.kind == sim::MotionKind::Feed) add(ends, motion.to[0], motion.to[1], motion.to[2]);
  }
};

} // namespace

TEST_CASE("sim cycles: the positions of rs274 on random programs") {
  const char* const peer = std::getenv("DOTEK_RS274");
  if (peer == nullptr) {
    tests::skip("no rs274: set DOTEK_RS274");
    return;
  }
  const char* const given = std::getenv("DOTEK_RS274_COUNT");
  const int count = given != nullptr ? std::atoi(given) : 200;
  const tests::ProcessFolder folder;
  folder.write("tools", "T1 P1 D1 Z0\n");
  int positions = 0, wrong = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const Holes made(static_cast<unsigned>(seed));
    folder.write("one.ngc", made.text + "M2\n");
    const tests::ShellResult out = folder.run(
        fmt::format("cd {} && rm -f v && {} -g -t tools -v v one.ngc 2>&1", folder.path("."), peer));
    Ends theirs;
    std::istringstream lines(out.out);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t rapid = line.find("STRAIGHT_TRAVERSE("), feed = line.find("STRAIGHT_FEED(");
      if (feed == std::string::npos && (rapid == std::string::npos || made.pecks())) continue;
      std::array<double, 3> v{};
      std::sscanf(line.c_str() + line.find('(') + 1, "%lf, %lf, %lf", &v[0], &v[1], &v[2]);
      add(theirs, v[0], v[1], v[2]);
    }
    std::string text = made.text;
    for (std::size_t at; (at = text.find(" L")) != std::string::npos;)
      text[at + 1] = 'K';
    if (const std::size_t at = text.find("P0.5"); at != std::string::npos) text.replace(at, 4, "P500");
    Simulation s;
    Motions motions;
    motions.feeds = made.pecks();
    s.machine->setWatcher(&motions);
    s.run(text + "M30\n");
    positions += static_cast<int>(theirs.size());
    if (s.state() == "end" && theirs == motions.ends) continue;
    if (++wrong > 4) continue;
    MESSAGE(fmt::format("seed {}\n{}\nrs274: {}\nDotek: {} {}\n{}", seed, made.text, fmt::join(theirs, " | "),
                        s.state(), s.machine->end().text, fmt::join(motions.ends, " | ")));
  }
  MESSAGE(fmt::format("{} programs and {} positions compared", count, positions));
  CHECK(wrong == 0);
}
