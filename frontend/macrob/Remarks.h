// Comments as other controls write them: `; text`, `// text`.
#pragma once

#include <cstddef>
#include <string_view>

namespace dotek::frontend::macrob {

// The signs that begin such a comment at `at`: 1 for `;`, 2 for `//`; 0: none does. `line` ends where its
// line does. A `;` that a block follows, or nothing, ends the block before it.
std::size_t remarkAt(std::string_view line, std::size_t at);

} // namespace dotek::frontend::macrob
