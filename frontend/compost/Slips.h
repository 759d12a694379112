// Words of a Prog that were meant to be others.
#pragma once

#include <string_view>

namespace dotek::frontend::compost {

// One slip of the hand, or an abbreviation written out, makes `written` the name `known`. Names that differ
// in an axis, a number, or ON and OFF are names of their own.
bool isSlip(std::string_view written, std::string_view known);

} // namespace dotek::frontend::compost
