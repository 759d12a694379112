// Runs a cycle by its meaning from a known state of the machine in a world, and records what it does.
#pragma once

#include "sim/cycle/CycleRun.h"
#include "verify/Stand.h"

#include <cstdint>
#include <set>
#include <vector>

namespace dotek::verify {

class CycleStand {
public:
  explicit CycleStand(const Limits& limits) : limits_(limits) {} // they outlive the stand

  // `inputs` without what the world's probe says: radii and length are taken from it. Of `entry` blocks and
  // modal codes do not matter, as no control executes anything. `stores`: common variables whose end values
  // count. `movePath`: Stand::Way::MovePath. `way`: takes the way of the run; nullptr: nobody looks.
  Record run(const ir::Cycle& cycle, sim::CycleInputs inputs, sim::World& world, const Entry& entry,
             const std::set<std::uint32_t>& stores, bool keepMoves = false, bool movePath = false,
             const Interference& interference = {}, sim::CycleWay* way = nullptr) const;
  // The surfaces that its touches expect, in the order of the run, where each is found at its place; of a run
  // that does not come to its end those before it, and `ending` says so.
  struct Rehearsal {
    std::vector<Touch> surfaces;
    std::vector<bool> mayMiss; // of each: the cycle goes on where nothing is found
    Ending ending = Ending::Finished;
    std::string text; // why it did not
    SourceRange at;
  };
  Rehearsal rehearse(const ir::Cycle& cycle, sim::CycleInputs inputs, const sim::Probe& probe,
                     const Entry& entry) const;

private:
  const Limits& limits_;
};

} // namespace dotek::verify
