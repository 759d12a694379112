// What each G and M code does, looked up by its number: built once from a control's table.
#pragma once

#include "stdlib/Control.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace dotek::sim {

// Modal state: of the functions that end one another one is in force. A slot holds its value.
enum Slot : std::uint8_t {
  kScratch, // written, never read: codes that set nothing
  kMotion,  // Motion
  kPlane,   // 0 XY, 1 ZX, 2 YZ
  kDistance,
  kUnits,
  kFeedMode,
  kComp,    // 0 off, 1 left, 2 right
  kLength,  // 0 off, 1 plus, 2 minus
  kSystem,  // 0 to 5: G54 to G59; kExtended: G54.1
  kCanned,  // 0 off, 1 a cycle, 2 back boring
  kReturn,  // 0 initial level, 1 level R
  kSurface, // 0: S turns a minute, 1: S is the speed of the surface
  kSlots
};
enum Motion : std::uint8_t {
  kRapid,
  kFeed,
  kArcClockwise,
  kArcCounterClockwise,
  kThread, // of a lathe, as its single cycles
  kTurningCycle,
  kThreadingCycle,
  kFacingCycle,
  kMotions
};
constexpr bool isArc(std::uint8_t motion) {
  return motion == kArcClockwise || motion == kArcCounterClockwise;
}
inline constexpr std::uint8_t kExtended = 6;

struct Code {
  enum Flag : std::uint8_t {
    Plain = 0,
    Long = 1,    // does more than setting its slot
    OneShot = 2, // in its block only, and it takes the axes
    Unknown = 4, // not in the table
  };
  stdlib::Function function = stdlib::Function::Other;
  std::uint8_t slot = kScratch;
  std::uint8_t value = 0;
  std::uint8_t flags = Unknown | Long;
  std::uint8_t group = 0; // modal group; 0: none
  std::uint32_t tenths = 0;
};

inline constexpr std::uint8_t kGroups = 64;

class CodeTable {
public:
  explicit CodeTable(const stdlib::Control& control);

  const Code& g(std::uint32_t tenths) const {
    return codes_[tenths < kDirect ? direct_[tenths] : far('G', tenths)];
  }
  const Code& m(std::uint32_t number) const { return codes_[far('M', number * 10)]; }
  // The first code with this meaning; nullptr: the control has none.
  const Code* find(stdlib::Function function) const;

private:
  static constexpr std::uint32_t kDirect = 2048; // G0 to G204.7
  std::uint16_t far(char letter, std::uint32_t tenths) const;

  std::vector<Code> codes_; // the first is the unknown one
  std::array<std::uint16_t, kDirect> direct_{};
  std::vector<std::pair<std::uint64_t, std::uint16_t>> sorted_; // letter and tenths
};

} // namespace dotek::sim
