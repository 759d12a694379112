// What a signature needs of its arguments. Private to the loader.
#pragma once

#include "stdlib/MacroSet.h"

#include <string>
#include <vector>

namespace dotek::stdlib {

// Why a call of the signature could not be understood: a call that says less than its intent needs.
std::vector<std::string> intentDefects(const MacroSignature& signature);

} // namespace dotek::stdlib
