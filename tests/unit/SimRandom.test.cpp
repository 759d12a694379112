// Random blocks: the machine against a slow implementation that is written another way. It keeps the
// machine's coordinates as the truth and works out everything else from them for each block.
#include "SimHarness.h"
#include "tests/Draws.h"

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

using namespace dotek;
using tests::Simulation;

namespace {

using Words = std::vector<std::pair<char, double>>;

class Slow {
public:
  std::string error; // "alarm 20"; "": runs

  void run(const Words& words) {
    std::map<char, double> value;
    int special = 0;
    for (const auto& [letter, number] : words) {
      if (letter != 'G') {
        value[letter] = number;
        continue;
      }
      const int code = static_cast<int>(number);
      if (code <= 3) motion_ = code, cycle_ = 0, level_.clear();
      if (code >= 17 && code <= 19) plane_ = code;
      if (code == 20) inch_ = true;
      if (code == 21) inch_ = false;
      if (code == 80) cycle_ = 0, level_.clear();
      if (code == 81 || code == 83) cycle_ = code;
      if (code == 90) absolute_ = true;
      if (code == 91) absolute_ = false;
      if (code == 98 || code == 99) return_ = code;
      if (code >= 54 && code <= 59) system_ = code;
      if (code == 10 || code == 52 || code == 92 || code == 53 || code == 28) special = code;
    }
    for (auto& [letter, number] : value)
      if (std::string_view("XYZIJKRF").find(letter) != std::string_view::npos && inch_) number *= 25.4;
    if (value.contains('F')) feed_ = value['F'];
    std::map<char, double> work;
    for (const char axis : {'X', 'Y', 'Z'})
      work[axis] = machine_[axis] - zero(axis);
    const char first = plane_ == 17 ? 'X' : plane_ == 18 ? 'Z' : 'Y';
    const char second = plane_ == 17 ? 'Y' : plane_ == 18 ? 'X' : 'Z';
    const char third = plane_ == 17 ? 'Z' : plane_ == 18 ? 'Y' : 'X';
    const char i = plane_ == 17 ? 'I' : plane_ == 18 ? 'K' : 'J';
    const char j = plane_ == 17 ? 'J' : plane_ == 18 ? 'I' : 'K';
    std::map<char, double> end = work;
    for (const char axis : {'X', 'Y', 'Z'})
      if (value.contains(axis)) end[axis] = value[axis] + (absolute_ ? 0 : work[axis]);
    const bool axes = value.contains('X') || value.contains('Y') || value.contains('Z');
    if (special == 10) {
      auto& offset = offsets_[static_cast<int>(value['P'])];
      for (const char axis : {'X', 'Y', 'Z'})
        if (value.contains(axis)) offset[axis] = value[axis] + (absolute_ ? 0 : offset[axis]);
      return;
    }
    if (special == 52) {
      for (const char axis : {'X', 'Y', 'Z'})
        if (value.contains(axis)) local_[axis] = value[axis];
      return;
    }
    if (special == 92) {
      for (const char axis : {'X', 'Y', 'Z'}) {
        if (!value.contains(axis)) continue;
        local_[axis] = 0;
        shift_[axis] += machine_[axis] - zero(axis) - value[axis];
      }
      return;
    }
    if (special == 53) {
      for (const char axis : {'X', 'Y', 'Z'})
        if (value.contains(axis)) machine_[axis] = value[axis];
      return;
    }
    if (special == 28) {
      for (const char axis : {'X', 'Y', 'Z'})
        if (!axes || value.contains(axis)) machine_[axis] = 0; // without axes all of them
      return;
    }
    if (cycle_ != 0) {
      if (level_.empty()) level_["initial"] = work[third];
      if (!axes && !value.contains('R')) return;
      if (feed_ <= 0) return fail("alarm 11");
      if (value.contains('R')) level_["R"] = value['R'] + (absolute_ ? 0 : level_["initial"]);
      if (!level_.contains("R")) return fail("inconclusive G");
      if (value.contains(third)) level_["depth"] = 1;
      if (!level_.contains("depth")) return fail("inconclusive G");
      end[third] = return_ == 98 ? level_["initial"] : level_["R"];
    } else if (motion_ >= 2 && (axes || value.contains(i) || value.contains(j))) {
      if (feed_ <= 0) return fail("alarm 11");
      const double r = std::sqrt(value[i] * value[i] + value[j] * value[j]);
      const double u = end[first] - work[first] - value[i], v = end[second] - work[second] - value[j];
      if (std::abs(r - std::sqrt(u * u + v * v)) > 0.03) return fail("alarm 20");
    } else if (motion_ == 1 && axes && feed_ <= 0) {
      return fail("alarm 11");
    }
    for (const char axis : {'X', 'Y', 'Z'})
      machine_[axis] = end[axis] + zero(axis);
  }

  double work(char axis) { return machine_[axis] - zero(axis); }
  double machine(char axis) { return machine_[axis]; }
  bool canned() const { return cycle_ != 0; }
  int motion() const { return motion_; }
  int plane() const { return plane_; }

private:
  double zero(char axis) {
    return offsets_[0][axis] + offsets_[system_ - 53][axis] + local_[axis] + shift_[axis];
  }
  void fail(const std::string& text) { error = text; }

  std::map<char, double> machine_, local_, shift_;
  std::map<int, std::map<char, double>> offsets_; // by P of G10 L2
  std::map<std::string, double> level_;
  int motion_ = 0, plane_ = 17, cycle_ = 0, return_ = 98, system_ = 54;
  bool absolute_ = true, inch_ = false;
  double feed_ = 0;
};

class Generator {
public:
  explicit Generator(unsigned seed) : random_(seed) {}

  Words block(const Slow& state) {
    Words out;
    const auto add = [&](char letter, double value) { out.emplace_back(letter, value); };
    const auto axes = [&](unsigned chance) {
      for (const char axis : {'X', 'Y', 'Z'})
        if (below(100) < chance) add(axis, length());
    };
    switch (below(24)) {
    case 0: add('G', 90 + below(2)); break;
    case 1: add('G', 20 + below(2)); break;
    case 2: add('G', 54 + below(6)); break;
    case 3:
      if (!state.canned()) add('G', 17 + below(3));
      break;
    case 4: add('F', below(3) == 0 ? 0 : 10 + below(500)); return out;
    case 5: add('G', 98 + below(2)); return out;
    case 6:
      add('G', 10), add('L', 2), add('P', below(7));
      axes(40);
      return out;
    case 7:
      add('G', 90), add('G', 52);
      axes(40);
      return out;
    case 8:
      add('G', 92);
      axes(40);
      return out;
    case 9:
      add('G', 0), add('G', 90), add('G', 53);
      axes(40);
      return out;
    case 10:
      if (state.canned())
        add('G', 80);
      else
        add('G', 28), axes(40);
      return out;
    case 11:
    case 12:
      add('G', below(2) == 0 ? 81 : 83);
      axes(70);
      if (below(3) != 0) add('R', length());
      return out;
    case 13:
    case 14: { // an arc whose end is its begin, or any
      add('G', 2 + below(2));
      const int plane = state.plane();
      add(plane == 18 ? 'K' : plane == 17 ? 'I' : 'J', length());
      if (below(2) == 0) add(plane == 18 ? 'I' : plane == 17 ? 'J' : 'K', length());
      if (below(12) == 0) axes(50);
      return out;
    }
    case 15: return out;
    default: add('G', below(2)); break;
    }
    if (state.motion() >= 2 && out.empty()) add('G', 1);
    if (!out.empty() && out.front().first == 'G' && out.front().second > 3 && state.motion() >= 2 &&
        !state.canned())
      return out;
    axes(60);
    if (below(8) == 0) add('F', 1 + below(1000));
    return out;
  }

  std::string text(const Words& words) {
    std::string out;
    for (const auto& [letter, value] : words) {
      const bool whole = letter == 'G' || letter == 'L' || letter == 'P';
      out += below(2) == 0 ? " " : "";
      out += whole ? fmt::format("{}{:.0f}", letter, value) : fmt::format("{}{:.3f}", letter, value);
    }
    return out + (below(3) == 0 ? "(note)\n" : "\n");
  }

private:
  unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }
  double length() { return (static_cast<int>(below(20001)) - 10000) / 1000.0; }
  std::mt19937 random_;
};

} // namespace

TEST_CASE("sim: random blocks end where a slow implementation ends") {
  int blocks = 0, alarms = 0;
  const int programs = tests::draws(5000);
  for (int seed = 1; seed <= programs; ++seed) {
    Generator generator(static_cast<unsigned>(seed));
    Simulation fast;
    Slow slow;
    std::string program;
    for (int i = 0; i < 40; ++i) {
      const Words words = generator.block(slow);
      if (words.empty()) continue;
      const std::string text = generator.text(words);
      program += text;
      slow.run(words);
      fast.run(text);
      ++blocks;
      CAPTURE(seed);
      CAPTURE(program);
      if (!slow.error.empty() || fast.state() != "running") {
        ++alarms;
        REQUIRE(fast.state() == slow.error);
        break;
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const char letter = "XYZ"[axis];
        REQUIRE(std::abs(fast.machine->position()[axis] - slow.work(letter)) < 1e-5);
        REQUIRE(std::abs(fast.machine->machinePosition()[axis] - slow.machine(letter)) < 1e-5);
      }
    }
  }
  CHECK(blocks > 4 * programs);
  CHECK(alarms > programs / 50);
}
