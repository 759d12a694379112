// Texts of inputs, names of files among them, as they may be shown: on a terminal, in JSON.
#pragma once

#include <string>
#include <string_view>

namespace dotek {

// What would steer a terminal or turn the order of its letters is `?`: control characters (a tab becomes a
// blank), C1, marks of direction, line and paragraph separators, and bytes that are no UTF-8.
std::string printable(std::string_view bytes);

// The same of a text of several lines, which keep their ends and their tabs.
std::string printableLines(std::string_view bytes);

// As UTF-8 without loss: a byte that is none of it becomes `\xHH`.
std::string asUtf8(std::string_view bytes);

// A JSON string with its quotes; what printable() would replace is escaped, a byte that is no UTF-8 is `\xHH`
// in the text.
std::string jsonString(std::string_view bytes);

// A number with `places` decimals; `null` where it is none (an infinity, no number).
std::string jsonNumber(double value, int places);

// The same escapes in JSON that is finished.
std::string escapeMarks(std::string_view json);

} // namespace dotek
