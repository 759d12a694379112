// The moves of a path that cutter compensation offsets. Private to the machine.
#pragma once

#include "sim/machine/Axes.h"
#include "sim/machine/Machine.h"
#include "sim/machine/OffsetCorner.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace dotek::sim {

// A move as the program has it.
struct OffsetStep {
  Position from{}, to{};
  PlaneMove move;
  std::uint8_t motion = kFeed, feedMode = 0;
  double feed = 0;
  std::uint64_t line = 0;
  std::uint32_t axes = 0; // bits
  std::size_t place = 0;  // in the trace
};

struct OffsetQueue {
  enum class Stage : std::uint8_t {
    Off,
    Begun,   // the first move waits: it goes straight to where the next one begins
    On,      // a move waits that begins at `at`
    Leaving, // G40 without a move: the tool is beside the path by `vector`
  };
  Stage stage = Stage::Off;
  std::size_t plane = 0;
  double radius = 0; // to the left
  PlanePoint at, vector;
  std::vector<OffsetStep> waiting; // the first one in the plane, then those beside it
  bool moved = false;              // the block that runs moves in the plane
  unsigned between = 0;            // blocks after the first one that do not move in the plane
};

class OffsetWork {
public:
  explicit OffsetWork(Machine& machine) : machine_(machine) {}

  bool before(const ir::NcWords& words);
  void after(const ir::NcWords& words);
  bool move(const Position& end, std::uint32_t axes, const std::optional<std::array<double, 2>>& centre);
  void atEnd(); // of the program

private:
  bool refuse(std::string_view what, char letter) const;
  double radiusOf(double d) const;
  void finish();
  bool leave();
  bool enter(const OffsetStep& next);
  bool fits(const OffsetStep& lead, PlanePoint begin, PlanePoint end) const;
  bool raiseAt(const OffsetStep& step, std::string_view why) const;
  PlanePoint plane(const OffsetStep& step, bool end) const;
  void emitWaiting(PlanePoint begin, PlanePoint end);
  std::size_t emit(const OffsetStep& step, PlanePoint begin, PlanePoint end);

  Machine& machine_;
};

} // namespace dotek::sim
