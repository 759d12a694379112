// Text for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace dotek {

// The words of one paragraph in lines of at most 90 characters, as far as words allow, each with its line
// end.
std::string wrapped(std::string_view text);

} // namespace dotek
