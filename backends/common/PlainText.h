// Texts for controls: ASCII, accents dropped, folded into lines.
#pragma once

#include "support/Ascii.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::backends {

struct PlainText {
  std::string text;     // printable ASCII
  bool changed = false; // an accent was dropped, or a blank stands for what control characters were
  bool lost = false;    // '?' stands for a character without a plain form
};

// `utf8` without accents: the base letter of each accented one, plain quotes and dashes. Control characters
// become blanks.
PlainText plainText(std::string_view utf8);

// Lines of at most `width` characters, split at blanks; a longer word is cut. No line is empty; an empty text
// gives none.
std::vector<std::string> wrapWords(std::string_view text, std::size_t width);

} // namespace dotek::backends
