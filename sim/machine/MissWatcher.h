// Who follows what skip moves that met nothing have left in variables.
#pragma once

#include <cstdint>

namespace dotek::sim {

class MissWatcher {
public:
  virtual ~MissWatcher() = default;
  // Whether a skip move of the run has met nothing.
  virtual bool hasMisses() const = 0;
  // The skip move, counted from 1, of whose end this variable would say something now; 0: none.
  virtual std::uint32_t missIn(std::uint32_t variable) const = 0;
  // A block that has run shifts or turns the coordinates (G52, G92, G68) by words that come from that one.
  virtual void shiftedBy(std::uint32_t miss) = 0;
  // A block that has run gives the place where the machine is new coordinates of these axes (G92), by
  // bit: X 1, Y 2, Z 4.
  virtual void placeSet(std::uint32_t axes) = 0;
};

} // namespace dotek::sim
