// Modal codes that a program keeps in variables and puts back: #1=#4001 ... G#1.
#pragma once

#include "ir/NumberSet.h"
#include "ir/Program.h"
#include "stdlib/Control.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace dotek::backends::fanuc {

// Variables by what is written into them.
struct ModeVariables {
  std::set<std::uint32_t> modes;  // holds such codes alone
  std::set<std::uint32_t> others; // holds something else, or may
};

// The common variables of a file. `control`: the one that the file is written for.
ModeVariables modeVariables(const ir::ProgramFile& file, const stdlib::Control& control);

class SavedModes {
public:
  // `common`: of the file of the program; outlives this object.
  SavedModes(const ir::Program& program, const ModeVariables& common, const stdlib::Control& control);

  // The value of a G word in the statement at `at` is the code in force of a modal group: read there, or kept
  // in a variable that holds nothing else and is set on every path to it.
  bool restores(const ir::ExpressionPtr& value, std::size_t at) const;

private:
  std::vector<std::optional<ir::NumberSet>> set_; // variables of modes, before each statement
  std::uint32_t first_ = 0, last_ = 0;            // #4001 to #4099; 0: the control has none
};

} // namespace dotek::backends::fanuc
