// Macros whose text is not there: what a call of them does by its meaning.
#pragma once

#include <cstdint>
#include <span>

namespace dotek::sim {

class Machine;

class MacroMeaning {
public:
  virtual ~MacroMeaning() = default;
  // The macro has a meaning; whether a call's arguments fit it is seen when it runs.
  virtual bool knows(std::uint32_t program) const = 0;
  // Carries the call out. `locals` by number, from #0 (unused) on: the arguments, kNull where there is none.
  // false: the run has ended (Machine::end says how): an alarm of the macro, or inconclusive.
  virtual bool run(Machine& machine, std::uint32_t program, std::span<const double> locals) = 0;
};

} // namespace dotek::sim
