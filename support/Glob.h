// Patterns of paths, as in `dotek.toml`.
#pragma once

#include <string_view>

namespace dotek {

// Whether a pattern takes a path, both with `/` between their parts. `*` takes any characters of one part,
// `?` one of them, `**` as a part any number of parts, none included. Letters count as they are written. A
// pattern without `/` takes names at any depth; one that takes a folder takes all that is in it.
bool matchesGlob(std::string_view pattern, std::string_view path);

} // namespace dotek
