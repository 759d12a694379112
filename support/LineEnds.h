// Where a line of a text ends, for readers that go through it once.
#pragma once

#include <cstddef>
#include <string_view>

namespace dotek {

// The byte of the first CR or LF at or after `from`; the size of the text where there is none. Unlike
// find_first_of it does not search its set anew for each byte.
constexpr std::size_t endOfLine(std::string_view text, std::size_t from) {
  while (from < text.size() && text[from] != '\n' && text[from] != '\r')
    ++from;
  return from < text.size() ? from : text.size();
}

} // namespace dotek
