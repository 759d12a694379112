// Offset paths of random programs beside LinuxCNC's rs274, where the rules are the same: outside corners as
// arcs, inside corners where the offset moves meet, begin and end in line with the moves beside them.
// DOTEK_RS274 names the program (docs/testing.md).
#include "SimHarness.h"
#include "tests/Process.h"
#include "tests/Skips.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <vector>

using namespace dotek;
using tests::Simulation;

namespace {

using Ends = std::vector<std::string>;

// A program of moves in the plane; each corner turns by at most 150 degrees.
class Made {
public:
  explicit Made(unsigned seed) : random_(seed) {
    radius = number(0.5, 6);
    plane_ = whole(0, 1); // it has no compensation in YZ
    angle_ = number(0, 360);
    left_ = whole(0, 1) == 1;
    text = fmt::format("G21 G90 {}\nG0 {}\n", plane_ == 0 ? "G17" : "G18", place());
    step(whole(8, 20));
    text += fmt::format("{} D1 G1 {} F100\n", left_ ? "G41" : "G42", place());
    step(whole(8, 30)); // in line with the begin
    text += "G1 " + place() + "\n";
    for (int i = whole(1, 7); i > 0; --i) {
      if (whole(0, 2) == 0)
        arc();
      else
        line();
    }
    step(whole(8, 20));
    text += "G40 G1 " + place() + "\n";
  }
  std::string text;
  double radius = 0;

private:
  int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  double number(double from, double to) {
    const double value = std::uniform_real_distribution<double>(from, to)(random_);
    return std::round(value * 1000) / 1000;
  }
  // rs274 passes over corners of less than 0.05, which is 2.9 degrees.
  double corner(double most) { return number(4, most) * (whole(0, 1) == 0 ? 1 : -1); }
  void step(double by) {
    u_ += by * std::cos(angle_ * std::numbers::pi / 180);
    v_ += by * std::sin(angle_ * std::numbers::pi / 180);
    u_ = std::round(u_ * 1000) / 1000;
    v_ = std::round(v_ * 1000) / 1000;
  }
  std::string place() const {
    static constexpr const char* kNames[3] = {"XY", "ZX", "YZ"};
    return fmt::format("{}{:.3f} {}{:.3f}", kNames[plane_][0], u_, kNames[plane_][1], v_);
  }
  void line() {
    angle_ += whole(0, 3) == 0 ? 0 : corner(150);
    step(number(5, 40));
    text += "G1 " + place() + "\n";
  }
  // By its radius, which may lie off the tangent of what is before it.
  void arc() {
    angle_ += whole(0, 1) == 0 ? 0 : corner(90);
    const bool clockwise = whole(0, 1) == 1;
    const double r = number(4, 25), sweep = number(30, 150);
    const double half = clockwise ? -sweep / 2 : sweep / 2;
    angle_ += half;
    step(2 * r * std::sin(sweep / 2 * std::numbers::pi / 180));
    angle_ += half;
    text += fmt::format("{} {} R{:.3f}\n", clockwise ? "G2" : "G3", place(), r);
  }

  std::mt19937 random_;
  int plane_ = 0;
  bool left_ = false;
  double u_ = 0, v_ = 0, angle_ = 0;
};

// Ends of motions: "X Y Z" of lines of the trace that move, alike ones after another once.
void add(Ends& ends, double x, double y, double z) {
  std::string one = fmt::format("{:.3f} {:.3f} {:.3f}", x + 0.0, y + 0.0, z + 0.0);
  if (ends.empty() || ends.back() != one) ends.push_back(std::move(one));
}

} // namespace

TEST_CASE("sim offset: the positions of rs274 on random programs") {
  const char* const peer = std::getenv("DOTEK_RS274");
  if (peer == nullptr) {
    tests::skip("no rs274: set DOTEK_RS274");
    return;
  }
  const char* const given = std::getenv("DOTEK_RS274_COUNT");
  const int count = given != nullptr ? std::atoi(given) : 200;
  const tests::ProcessFolder folder;
  int compared = 0, positions = 0, refusedByBoth = 0, refusedAlone = 0, wrong = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const Made made(static_cast<unsigned>(seed));
    folder.write("tools", fmt::format("T1 P1 D{:.9f} Z0\n", 2 * made.radius / 25.4));
    folder.write("one.ngc", made.text + "M2\n");
    const tests::ShellResult out = folder.run(
        fmt::format("cd {} && rm -f v && {} -g -t tools -v v one.ngc 2>&1", folder.path("."), peer));
    Ends theirs, ours;
    std::istringstream lines(out.out);
    std::array<double, 3> now{};
    bool refused = false;
    static constexpr std::size_t kAxes[3][3] = {{0, 1, 2}, {2, 0, 1}, {1, 2, 0}};
    const std::size_t plane = made.text.find("G18") < 12 ? 1 : made.text.find("G19") < 12 ? 2 : 0;
    for (std::string line; std::getline(lines, line);) {
      std::array<double, 6> v{};
      const auto read = [&](const char* name) {
        const std::size_t at = line.find(name);
        if (at == std::string::npos) return false;
        std::istringstream rest(line.substr(at + std::string_view(name).size()));
        char comma = 0;
        for (double& one : v)
          rest >> one >> comma;
        return true;
      };
      if (read("STRAIGHT_TRAVERSE(") || read("STRAIGHT_FEED(")) {
        now = {v[0], v[1], v[2]};
      } else if (read("ARC_FEED(")) {
        now[kAxes[plane][0]] = v[0];
        now[kAxes[plane][1]] = v[1];
      } else {
        refused = refused || line.find("cutter") != std::string::npos ||
                  line.find("gouging") != std::string::npos || line.find("ool radius") != std::string::npos;
        continue;
      }
      add(theirs, now[0], now[1], now[2]);
    }
    refused = out.out.find("PROGRAM_END") == std::string::npos;
    Simulation s("fanuc-31i-b");
    s.machine->roundOffsetCorners(true);
    REQUIRE(s.machine->preset(13001, made.radius));
    std::string written;
    sim::Trace trace([&](std::string_view text) { written += text; });
    s.machine->setTrace(&trace);
    s.run(made.text + "M30\n");
    trace.flush();
    s.machine->setTrace(nullptr);
    std::istringstream own(written);
    for (std::string line; std::getline(own, line);) {
      const std::size_t x = line.find(" X");
      if (x == std::string::npos) continue;
      std::array<double, 3> v{};
      std::sscanf(line.c_str() + x, " X%lf Y%lf Z%lf", &v[0], &v[1], &v[2]);
      add(ours, v[0], v[1], v[2]);
    }
    const bool alarm = s.machine->end().ending == sim::Ending::Alarm;
    if (alarm && refused) {
      ++refusedByBoth;
      continue;
    }
    ++compared;
    positions += static_cast<int>(theirs.size());
    constexpr double kNear = 0.005; // mm: it prints four decimals, and the begin is in line but for rounding
    const auto near = [](const std::string& a, const std::string& b) {
      std::array<double, 6> v{};
      std::sscanf((a + " " + b).c_str(), "%lf %lf %lf %lf %lf %lf", &v[0], &v[1], &v[2], &v[3], &v[4], &v[5]);
      return std::abs(v[0] - v[3]) < kNear && std::abs(v[1] - v[4]) < kNear && std::abs(v[2] - v[5]) < kNear;
    };
    // It runs some moves that are shorter than their corners take: the positions before are the same.
    const bool alone = alarm && !refused;
    refusedAlone += alone ? 1 : 0;
    bool same = alone ? theirs.size() > ours.size() : alarm == refused && theirs.size() == ours.size();
    for (std::size_t i = 0; same && i < ours.size(); ++i)
      same = near(theirs[i], ours[i]);
    if (same) continue;
    if (++wrong > 5) continue;
    MESSAGE(fmt::format("seed {} radius {}\n{}\nrs274: {}\n{}\nDotek: {} {}\n{}", seed, made.radius,
                        made.text,
                        refused ? out.out.substr(out.out.size() > 300 ? out.out.size() - 300 : 0) : "ran",
                        fmt::join(theirs, " | "), s.state(), s.machine->end().text, fmt::join(ours, " | ")));
  }
  MESSAGE(
      fmt::format("{} programs and {} positions compared, {} of them refused by Dotek alone, {} more by both",
                  compared, positions, refusedAlone, refusedByBoth));
  CHECK(wrong == 0);
  CHECK(refusedAlone * 100 <= count);
}
