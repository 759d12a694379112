// From NC blocks to the IR: functions by the control's table, macro calls by their signatures.
#pragma once

#include "frontend/nc/Block.h"
#include "ir/Cycle.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "support/Diagnostics.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::frontend::nc {

// Modal state along the blocks. Nothing: not known; G90 and G94 are taken to hold at the start of a cycle
// because `convert` sets them (docs/convert.md).
struct ModalState {
  std::optional<ir::Motion> motion;
  std::optional<bool> absolute = true;
  std::optional<bool> feedPerMinute = true;
  ir::ExpressionPtr feed;                         // mm/min; null pointer: not stated yet
  bool operator==(const ModalState& other) const; // compares expressions by ir::equal
};

// A picture that a target cannot follow, and what is printed with it.
struct PictureUse {
  SourceRange first;
  std::vector<std::string> names; // "the field `Z`", in the order of the blocks
  int decimals = 0;
};
using PictureUses = std::map<std::string, PictureUse>; // by the text of the picture

// Jumps within a branch, and what is in force where they lead to.
struct LiftFlow {
  struct Loop {
    std::uint64_t number = 0;
    ir::LabelId begin = 0, end = 0;
    SourceRange range;
    std::size_t place = 0; // of the branch's loops
  };
  std::map<std::uint64_t, ir::LabelId> targets; // N numbers that a GOTO of the branch names
  std::map<ir::LabelId, ModalState> arriving;   // with jumps to the label
  std::map<ir::LabelId, ModalState> entered;    // with which the blocks after the label were read
  std::map<std::size_t, ModalState> loopStates; // that arrive at the beginning of a loop, by its place
  std::vector<Loop> loops;                      // open ones
  std::size_t placed = 0;                       // loops so far
  bool reachable = true;                        // the block before goes on here
  bool again = false; // a jump back brings what was not known where the blocks were read
};

struct LiftContext {
  const stdlib::Control& control; // the source's machine: codes, decimal mode
  const stdlib::MacroSet* macros; // the set that the source calls; nullptr: it calls none
  ir::Cycle& cycle;
  Diagnostics& diagnostics;
  ModalState state = {};
  std::uint32_t nextBlock = 1;
  // Value of a variable that the command line fixes, for the checks of pictures; nullopt, or no function: it
  // varies.
  std::function<std::optional<double>(ir::VariableId)> fixed = {};
  Encoding encoding = Encoding::Utf8;               // of comments
  const stdlib::MacroSignature* measured = nullptr; // the last measurement; its results are in variables
  std::set<std::uint32_t> stored = {};              // variables that were assigned since the last call
  LiftFlow flow = {};
  PictureUses coarse = {};    // pictures with fewer decimals than the control
  PictureUses blankZero = {}; // pictures that print nothing for 0
};

// Appends the statements of the block to `out`: comments, modes, probe, spindle and coolant, dwell, motion or
// measurement, stop. Reports and returns false where the block has no single meaning: an unknown macro
// number, letters that no signature has, two motions, a code that a field chooses, a variable of the caller.
// A block with a function that Dotek does not translate becomes opaque, with a note; its words keep the
// number as written, whatever the decimal mode. Reads other numbers without a point under the control's
// decimal mode; a literal that the other mode reads differently is a warning with both values. Reports
// integer digits that do not fit a hole's picture where its value is fixed; what else is wrong with pictures
// is left to reportPictures(). A macro call leaves motion and feed unknown. Block numbers
// and a feed alone make no statement.
bool lift(const Block& block, LiftContext& context, std::vector<ir::CycleStatement>& out);

// All blocks of a branch, with the jumps between them: GOTO to N numbers of the branch, IF, WHILE. What is in
// force after a label is what all paths to it agree in.
bool liftAll(const std::vector<Block>& blocks, LiftContext& context, std::vector<ir::CycleStatement>& out);

// After the last block: one finding for each picture, with all that is printed with it.
void reportPictures(LiftContext& context);

// The programs that the block calls with G65, for choosing the macro set.
std::vector<std::uint32_t> programsCalled(const Block& block);

// Enters the modal G codes of the block by group: 3 -> "G91". A code that a hole prints is left out.
void noteModal(const Block& block, const stdlib::Control& control, std::map<int, std::string>& modal);

} // namespace dotek::frontend::nc
