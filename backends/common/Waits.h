// Blocks of a source that only wait.
#pragma once

#include "ir/Statement.h"
#include "stdlib/Control.h"

#include <cmath>

namespace dotek::backends {

// G53 without an axis: it moves nothing, and the control ends what it has read ahead.
inline bool isWait(const ir::OpaqueBlock& block, const stdlib::Control& control) {
  if (block.words.size() != 1 || block.words[0].address != 'G' || block.words[0].value == nullptr)
    return false;
  const double* code = ir::constantValue(block.words[0].value);
  if (code == nullptr || !(*code >= 0 && *code < 1000)) return false;
  const stdlib::CodeInfo* info = control.find('G', static_cast<std::uint32_t>(std::lround(*code * 10)));
  return info != nullptr && info->function == stdlib::Function::MachineCoordinates;
}

} // namespace dotek::backends
