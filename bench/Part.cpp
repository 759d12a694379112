// Cases of a probing cycle in three axes against a virtual part: how long 10,000 of them take.
//   bench_part [--cases N] [--check]
// A case is a part that lies otherwise, ten touches (a face, a boss, a bore, a slot, a corner), and the path
// to each. --check exits with 1 where the goal is missed.
#include "sim/machine/World.h"

#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <memory>
#include <string>

using namespace dotek::sim;

namespace {

constexpr double kGoal = 5; // seconds for 10,000 cases

class Random {
public:
  double between(double least, double most) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return least + (most - least) * static_cast<double>((state_ >> 33) % 1'000'001) / 1e6;
  }

private:
  std::uint64_t state_ = 20261121;
};

// A plate with a bore, a boss, a slot, a pocket and four holes.
std::unique_ptr<Part> plate() {
  using Action = PartBuilder::Action;
  PartBuilder builder;
  builder.box({0, 0, -20}, {120, 80, 0});
  builder.cylinder({30, 40, -20}, {30, 40, 0}, 15, Action::Remove);
  builder.cylinder({70, 25, 0}, {70, 25, 12}, 8);
  builder.block({70, 60, -4}, {0, 0, -1}, {1, 0, 0}, {18, 6, 4}, 6, Action::Remove);
  builder.block({102, 40, -3}, {0, 0, -1}, {1, 0, 0}, {10, 20, 3}, 3, Action::Remove);
  for (const double x : {8.0, 112.0}) {
    for (const double y : {8.0, 72.0})
      builder.cylinder({x, y, -20}, {x, y, 0}, 3, Action::Remove);
  }
  std::string fault;
  std::unique_ptr<Part> part = builder.finish(fault);
  if (!part) {
    fmt::print(stderr, "{}\n", fault);
    std::exit(1);
  }
  return part;
}

// Moves the ball's centre to points of the nominal part.
class Driver {
public:
  explicit Driver(World& world) : world_(world) { at_[2] = 100 + up(); }
  void rapid(double x, double y, double z) { go(MotionKind::Rapid, x, y, z); }
  void touch(double x, double y, double z) {
    SkipMove move;
    move.machineFrom = at_;
    move.machineTo = {x, y, z + up()};
    const auto share = world_.contact(move);
    touches += share ? 1 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      at_[axis] += (move.machineTo[axis] - at_[axis]) * share.value_or(1);
    const Position back = move.machineFrom;
    go(MotionKind::Rapid, back[0], back[1], back[2] - up());
  }
  std::uint64_t touches = 0, motions = 0;

private:
  double up() const { return world_.probe().centreLength(); }
  void go(MotionKind kind, double x, double y, double z) {
    MachineMotion motion;
    motion.kind = kind;
    motion.from = at_;
    motion.to = {x, y, z + up()};
    world_.moved(motion);
    at_ = motion.to;
    ++motions;
  }
  World& world_;
  Position at_{};
};

void runCase(Driver& driver) {
  driver.rapid(-12, 40, 20);
  driver.rapid(-12, 40, -6);
  driver.touch(10, 40, -6); // face
  driver.rapid(-12, 40, 20);
  driver.rapid(50, 40, 20);
  driver.touch(50, 40, -10); // top
  driver.rapid(30, 40, 10);
  driver.rapid(30, 40, -10);
  driver.touch(60, 40, -10); // bore, four sides
  driver.touch(0, 40, -10);
  driver.touch(30, 70, -10);
  driver.touch(30, 10, -10);
  driver.rapid(30, 40, 20);
  driver.rapid(90, 25, 20);
  driver.rapid(90, 25, 5);
  driver.touch(60, 25, 5); // boss
  driver.rapid(90, 25, 20);
  driver.rapid(70, 60, 20);
  driver.rapid(70, 60, -4);
  driver.touch(70, 80, -4); // slot
  driver.touch(70, 40, -4);
  driver.rapid(70, 60, 20);
  driver.rapid(102, 40, 20);
  driver.rapid(102, 40, -2);
  driver.touch(118, 54, -2); // pocket
  driver.rapid(102, 40, 30);
}

} // namespace

int main(int argc, char** argv) {
  int cases = 10'000;
  bool check = false;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--cases" && i + 1 < argc) {
      cases = std::max(1, std::atoi(argv[++i]));
    } else if (flag == "--check") {
      check = true;
    } else {
      fmt::print(stderr, "bench_part [--cases N] [--check]\n");
      return 2;
    }
  }
  const std::clock_t begin = std::clock();
  const auto since = [&] { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; };
  const std::unique_ptr<Part> part = plate();
  const double build = since();
  Probe probe;
  probe.ballDiameter = 4;
  probe.effectiveRadius = 2;
  probe.length = 150;
  probe.stemDiameter = 3;
  probe.stemLength = 50;
  probe.bodyDiameter = 40;
  probe.bodyLength = 60;
  probe.noise = 0.0003;
  World world(*part, probe);
  Random random;
  std::uint64_t touches = 0, motions = 0, events = 0;
  for (int n = 0; n < cases; ++n) {
    const auto r = [&](double size) { return random.between(-size, size); };
    world.setPart(part->placed({}, {{r(0.5), r(0.5), r(0.5)}, {r(0.1), r(0.1), r(0.3)}}));
    world.restart(static_cast<std::uint64_t>(n));
    Driver driver(world);
    runCase(driver);
    touches += driver.touches;
    motions += driver.motions;
    for (const ProbeEvent& event : world.events())
      events += event.outcome == Outcome::Contact ? 0 : 1;
  }
  const double seconds = since();
  const double goal = kGoal * cases / 10'000;
  fmt::print("| work | s | us a case | touches | other motions | trouble |\n|---|---|---|---|---|---|\n");
  fmt::print("| {} cases, part with 9 shapes | {:.2f} | {:.1f} | {} | {} | {} |\n", cases, seconds,
             seconds / cases * 1e6, touches, motions, events);
  fmt::print("| finding the edges of that part | {:.4f} | | | | |\n", build);
  if (seconds > goal) fmt::print("\nMISSED: {} s is the goal\n", goal);
  const bool sound = touches == static_cast<std::uint64_t>(cases) * 10 && events == 0;
  if (!sound) fmt::print("\nUNSOUND: each case has ten touches and no trouble\n");
  return !sound || (check && seconds > goal) ? 1 : 0;
}
