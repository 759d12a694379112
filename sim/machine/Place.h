// What a system variable stands for. Private to the machine.
#pragma once

#include "sim/machine/Machine.h"

#include <cstddef>
#include <cstdint>

namespace dotek::sim {

struct Machine::Place {
  enum class Kind : std::uint8_t {
    None,
    Modal,
    Word,
    BlockEnd,
    MachinePosition,
    Now,
    Skip,
    ToolLength,
    External,
    System,
    Extended,
    Wear,
    Geometry,
    Timer,
    Hours,
    ExtendedNumber,
    State,     // index in state_
    StateWord, // index of the range: its variables as bits
    WindowAddress,
    Window, // index: bytes
    Write,  // #3000, #3006: written only
  };
  Kind kind = Kind::None;
  std::size_t index = 0; // group, letter, system or offset
  std::size_t axis = 0;
};

} // namespace dotek::sim
