// Who wants to know what a run of a macro program gives a control to do: `dotek flatten`.
#pragma once

#include "ir/NcWords.h"
#include "ir/Statement.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace dotek::sim {

class RunListener {
public:
  virtual ~RunListener() = default;
  // The machine has carried out these words; the last block of a run is one of them. `points`: bits of the
  // letters that the program itself writes with a decimal point.
  virtual void blockDone(const ir::NcWords& words, std::uint32_t points) = 0;
  // Variables that no cell holds: offsets, positions, modal values, clocks. In units of the program.
  virtual void systemRead(std::uint32_t number, double value) = 0;
  virtual void systemWritten(std::uint32_t number, double value) = 0;
  virtual void message(std::string_view text) = 0; // #3006
  virtual void portSwitched(bool open) = 0;
  virtual void printed(bool binary, std::string_view line) = 0;
  virtual void named(const ir::NameVariables& names) = 0; // SETVN
  // A pass of a macro that no program holds, and that ran by its meaning; `locals` by number from #0 (unused)
  // on, kNull where there is none.
  virtual void meaningRan(std::uint32_t program, std::span<const double> locals) = 0;
  // What such a macro has measured: it is in this variable now, and this common variable, which still holds
  // it, is read.
  virtual void measuredWritten(std::uint32_t number) = 0;
  virtual void measuredRead(std::uint32_t number, double value) = 0;
};

} // namespace dotek::sim
