// The repair of a misspelt word.
#pragma once

#include "support/Diagnostics.h"

#include <algorithm>
#include <optional>
#include <string>

namespace dotek {

// The name that was meant in place of the text of the range. It changes what a file means: shown, not made by
// --fix. Nothing for "", and for a name beside ASCII, which each file has in its own encoding.
inline std::optional<Fix> writeInstead(SourceRange word, const std::string& meant) {
  const bool ascii = std::all_of(meant.begin(), meant.end(), [](char c) { return c > ' ' && c <= '~'; });
  if (meant.empty() || !ascii) return std::nullopt;
  return Fix{Fix::Applicability::Display, "write `" + meant + "`", {{word, meant}}};
}

} // namespace dotek
