// What the header of an edited translation says of its arguments.
#pragma once

#include <string>
#include <string_view>

namespace dotek::targets {

// Unit, default and range of each argument, and the letters of the call that the header shows, are those of
// the program that convert writes, and no argument has the meaning of another one. Rows and lines that are
// gone, and other words, are the editor's business. "" or what is wrong.
std::string whyHeaderDiffers(std::string_view converted, std::string_view edited);

} // namespace dotek::targets
