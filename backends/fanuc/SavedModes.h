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

class SavedModes {
public:
  // `control`: the one that the program is written for.
  SavedModes(const ir::Program& program, const ir::ProgramFile& file, const stdlib::Control& control);

  // The value of a G word in the statement at `at` is the code in force of a modal group: read there, or kept
  // in a variable that holds nothing else and is set on every path to it.
  bool restores(const ir::ExpressionPtr& value, std::size_t at) const;

private:
  std::set<std::uint32_t> modes_;                 // variables that hold such codes alone
  std::vector<std::optional<ir::NumberSet>> set_; // of them, before each statement
  std::uint32_t first_ = 0, last_ = 0;            // #4001 to #4099; 0: the control has none
};

} // namespace dotek::backends::fanuc
