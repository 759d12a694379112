// The beginning of a form's data file: the keywords that a Prog prints, as far as other forms know them.
#pragma once

#include "frontend/compost/Ast.h"
#include "stdlib/ComPostKeywords.h"
#include "stdlib/Form.h"
#include "support/Source.h"

#include <string>
#include <vector>

namespace dotek::project {

// TOML with one table for each keyword of the Prog that a form decides, in the order of first use. What some
// form of `known` has is copied with the grade `assumed`, the first one wins; other tables are comments with
// the place of the keyword, to be filled in.
std::string draftForm(const std::string& name, const frontend::compost::Program& program,
                      const SourceMap& sources, const stdlib::ComPostKeywords& keywords,
                      const std::vector<stdlib::Form>& known);

} // namespace dotek::project
