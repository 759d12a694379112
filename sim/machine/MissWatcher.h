// Who follows what skip moves that met nothing have left in variables.
#pragma once

#include "support/Source.h"

#include <cstdint>

namespace dotek::sim {

class MissWatcher {
public:
  virtual ~MissWatcher() = default;
  // Whether a skip move of the run has met nothing.
  virtual bool hasMisses() const = 0;
  // The skip move, counted from 1, of whose end this variable would say something now; 0: none.
  virtual std::uint32_t missIn(std::uint32_t variable) const = 0;
  // How far that move went along the axis of the variable, in units of the program.
  virtual double wayIn(std::uint32_t variable) const = 0;
  // A condition has looked at where a skip move ended that met nothing. `tells`: it would have come out
  // otherwise at another place of the move.
  virtual void askedAbout(std::uint32_t miss, bool tells, SourceRange block) = 0;
  // No condition has looked at the end of the last skip move, which met nothing; `passedAlarm`: one that
  // leads to an alarm has come out without it.
  virtual bool isOpen() const = 0;
  virtual void passedAlarm(SourceRange block) = 0;
  // A block that has run shifts or turns the coordinates (G52, G92, G68) by words that come from that one.
  virtual void shiftedBy(std::uint32_t miss) = 0;
  // A block that has run gives the place where the machine is new coordinates of these axes (G92), by
  // bit: X 1, Y 2, Z 4.
  virtual void placeSet(std::uint32_t axes) = 0;
};

} // namespace dotek::sim
