// The compiled machine after the interface of the slow evaluator.
#pragma once

#include "tests/unit/SlowMacroB.h"

#include <string>

namespace dotek::tests {

struct MachineRun {
  std::string refusal; // not "": the programs are not lowered or compiled, and why
  MacroOutcome outcome;
};

// Parses, lowers and runs the first program of a file. `line` of the outcome may be 0: not known.
MachineRun runOnMachine(const std::string& text, const MacroSetup& setup);

} // namespace dotek::tests
