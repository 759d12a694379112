// Texts and numbers as the files of pictures hold them.
#pragma once

#include <string>
#include <string_view>

namespace dotek::sim {

// For text and attributes of XML. Characters that XML does not know become blanks, bytes that are no UTF-8
// U+FFFD. At most `most` characters (code points); a longer text ends in an ellipsis.
std::string xmlText(std::string_view text, std::size_t most = 4000);

// A JSON string with its quotes that may appear in an HTML script element. The same care.
std::string jsonText(std::string_view text, std::size_t most = 4000);

// The shortest text with at most `places` decimals, at most 6: 12.5, -3, 0. `value` is finite.
std::string shortNumber(double value, int places);

} // namespace dotek::sim
