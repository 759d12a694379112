// Findings as text in colours.
#pragma once

#include "support/Diagnostics.h"

#include <cstdint>
#include <string>

namespace dotek {

enum class Colors : std::uint8_t { None, Terminal };

// As renderText of Diagnostics.h. Terminal: place, severity and caret stand out by the sequences of a
// terminal; the characters are the same.
std::string renderText(const Diagnostics& diagnostics, const SourceMap& sources, std::uint32_t maxErrors,
                       Colors colors);

} // namespace dotek
