// What a punched tape or a serial line leaves around a program.
#pragma once

#include <string>
#include <string_view>

namespace dotek {

// What lies before the first byte of a text and after its last one; bytes 0 and Ctrl-Z there are blanks.
inline constexpr std::string_view kBeforeTape("\0\r\n \t", 5);
inline constexpr std::string_view kAfterTape("\0\x1A\r\n \t", 6);

// Makes blanks of what a control passes over, so that all places stay: feed holes (bytes 0) before and after
// a program, the Ctrl-Z of a DOS file at its end, both after the `%` that ends it. Bytes 0 within a program
// stay what they are, a damaged copy; so do UTF-16 and texts that do not begin as NC does.
void blankTape(std::string& bytes);

} // namespace dotek
