// What the header of an edited translation says of its arguments.
#pragma once

#include <string>
#include <string_view>

namespace dotek::targets {

// Unit, default and range of each argument, and the letters of the call that the header shows, are those of
// the program that convert writes, no argument has the meaning of another one, and a line with the words of
// that program has its numbers. Where it still says what the caller provides, it says all of that, and the
// formulas of what is computed. Rows that are gone, other words, and the values of the call are the editor's
// business. "" or what is wrong.
std::string whyHeaderDiffers(std::string_view converted, std::string_view edited);

} // namespace dotek::targets
