// From NC blocks to the IR: functions by the control's table, macro calls by their signatures.
#pragma once

#include "frontend/nc/Block.h"
#include "ir/Cycle.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "support/Diagnostics.h"

#include <optional>
#include <vector>

namespace dotek::frontend::nc {

// Modal state along the blocks. Nothing: not known; G90 is taken to hold at the start of a cycle because
// `convert` sets it (docs/convert.md).
struct ModalState {
  std::optional<ir::Motion> motion;
  bool absolute = true;
  ir::ExpressionPtr feed;                         // null pointer: not stated yet
  bool operator==(const ModalState& other) const; // compares expressions by ir::equal
};

struct LiftContext {
  const stdlib::Control& control; // the source's machine: codes, decimal mode
  const stdlib::MacroSet* macros; // the set that the source calls; nullptr: it calls none
  ir::Cycle& cycle;
  Diagnostics& diagnostics;
  ModalState state;
  std::uint32_t nextBlock = 1;
};

// Appends the statements of the block to `out`. Reports and returns false where the block has no single
// meaning: an unknown macro number, letters that no signature has, an NC and a macro statement in one block,
// two motions, an address twice. A block with a function that Dotek does not translate becomes opaque, with
// a note. Reads numbers without a point under the control's decimal mode; a literal that the other mode reads
// differently is a warning with both values. Reports integer digits that do not fit a hole's picture where
// its value is constant, and (once per field) a picture with fewer decimals than the control.
bool lift(const Block& block, LiftContext& context, std::vector<ir::Statement>& out);

// The programs that the block calls with G65, for choosing the macro set.
std::vector<std::uint32_t> programsCalled(const Block& block);

} // namespace dotek::frontend::nc
