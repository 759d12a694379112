// Programs of lathes whose profile `--control` names.
#pragma once

#include "lint/Project.h"

#include <cstddef>

namespace dotek::lint {

// The control that the programs are linted for is a lathe's.
bool isForLathe(const Project& project);

// The word by which the block has a code of this meaning; nullptr: there is none.
const ir::Word* wordOf(const ir::NcBlock& block, const stdlib::Control& control, stdlib::Function function);

} // namespace dotek::lint
