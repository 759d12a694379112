// A tool length that a call corrects by what it measures, where the macro of the target has no letter for it.
#pragma once

#include "backends/common/CycleTolerances.h"

#include <optional>

namespace dotek::backends {

// The length of `tool` changes by `share` (0 to 1) of `error`, where that is not below `band`. Results of the
// macro are variables of the machine in `error`, mm.
struct ToolCorrection {
  ir::ExpressionPtr tool, error, share; // never null
  ir::ExpressionPtr band;               // null pointer: always
  bool geometry = true;                 // the register of the source's set; else the wear
};

// Takes tool, share and band out of the arguments of a call that measures a surface along Z. Nothing: the
// call corrects no tool, `signature` has a letter for it, or what the source's set does is not known (a share
// that the call does not state, a radius, a set that does not say which register it corrects).
std::optional<ToolCorrection> takeToolCorrection(ir::CallCycle& cycle, const stdlib::MacroSet* source,
                                                 const stdlib::MacroSignature& signature,
                                                 const ExpectedAlong& expected);

} // namespace dotek::backends
