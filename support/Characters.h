// How many characters bytes are.
#pragma once

#include "support/Source.h"

namespace dotek {

// Characters of toUtf8(bytes, encoding), without making the text.
std::size_t charactersOf(std::string_view bytes, Encoding encoding);

} // namespace dotek
