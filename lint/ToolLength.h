// Which values of a program hold the length of the tool. Along the tool's axis #5043 and #5063 are positions
// of the spindle: under G43 they hold the length of the tool (#5083) too, and a coordinate that a block moves
// to does not.
#pragma once

#include "lint/OffsetStates.h"
#include "lint/Probing.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace dotek::lint {

class NcProgram;

// A coordinate that is computed from a position without its length taken off, or a position that is held
// against one.
struct LengthLeftIn {
  // Difference: the position beside a height that the program moves to, subtracted or compared.
  // ToolOffset: a correction that is added to an offset of a tool, or the whole of its wear.
  enum class Place : std::uint8_t { Move, Argument, WorkOffset, ToolOffset, Difference };
  Place place = Place::Move;
  SourceRange range;  // of the word, of the statement that writes the offset, of the difference
  SourceRange value;  // of the coordinate, of a Difference the position's side; no place: not to be had
  double lengths = 1; // how often it holds the length: 1, or -1 where the position is subtracted
  std::uint32_t read = 5063; // the position
  SourceRange readAt;
  std::uint32_t length = 5083; // the variable of the length
  // The wear of a tool is a term of it, from variables where the geometry has numbers of its own: the first
  // numbers of both tables, those of offset 0.
  struct Wear {
    std::uint32_t wear = 2000, geometry = 2200;
  };
  std::optional<Wear> wear = std::nullopt;
  bool assigned = false;   // the value is all of what the statement sets: it needs no brackets
  bool taken = false;      // the length is taken off a coordinate that does not hold it; `read` is the length
  SourceRange passed = {}; // the call that passes the position, which its caller reads; no place: none
  SourceRange call = {};   // by which the program is called under G43; no place: nothing says so
};

// What profiles and files say of lengths, gathered once for all programs of a project, which outlives it.
class ToolLengths {
public:
  explicit ToolLengths(const Project& project);
  ~ToolLengths();
  ToolLengths(const ToolLengths&) = delete;
  ToolLengths& operator=(const ToolLengths&) = delete;

  // Those of the program, in the order of its statements. Silent where the control is not known to hold the
  // length in its positions, under G49, and where something else that may be the length is taken off: a
  // common variable that the program does not set, a tool offset. A position may come from the caller, or
  // from a program that is called, one call away and in the files.
  std::vector<LengthLeftIn> leftIn(const NcProgram& nc) const;

  // It gives an entry of the table of tools a new value: it runs with a tool that has none in force.
  bool measuresTool(const NcProgram& nc) const;
  // Whether programs of the files turn the offset on or off, and how they are called (OffsetStates.h).
  const std::set<std::uint32_t>& switching() const;
  const std::map<std::uint32_t, CalledUnder>& called() const;

  struct Known;

private:
  std::unique_ptr<const Known> known_;
};

// Computed once a project.
const ToolLengths& toolLengthsOf(const Project& project);

} // namespace dotek::lint
