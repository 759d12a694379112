// Texts of drawings that a listing prints among its blocks: letter, local variable, `=`, meaning.
#pragma once

#include <cstddef>
#include <string_view>

namespace dotek::frontend::macrob {

// Where in `line` the text of a drawing such as `D #7 = CUTTER DIA` begins: a letter of arguments, its own
// local variable, `=`, and words. npos: nowhere.
std::size_t findLegend(std::string_view line);

// Letters and not only capitals: the second line of such a text.
bool isPlainText(std::string_view text);

} // namespace dotek::frontend::macrob
