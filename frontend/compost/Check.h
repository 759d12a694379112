// Findings inside one Prog that need no other file.
#pragma once

#include "frontend/compost/Ast.h"
#include "stdlib/ComPostKeywords.h"
#include "support/Diagnostics.h"
#include "support/Source.h"

namespace dotek::frontend::compost {

// Words, pictures, flags and calls of a parsed Prog. What the parser reported is not repeated.
void check(const Program& program, const stdlib::ComPostKeywords& keywords, const SourceMap& sources,
           Diagnostics& diagnostics);

} // namespace dotek::frontend::compost
