// Findings as SARIF 2.1.0, for code hosts and editors.
#pragma once

#include "support/Diagnostics.h"

#include <string>
#include <string_view>
#include <vector>

namespace dotek {

// One code that the findings may have.
struct SarifRule {
  std::string_view code;
  Severity severity = Severity::Warning;
  std::string summary; // one sentence
  std::string help;    // what `explain` prints
  std::string helpMarkdown;
};

// `rules` holds the code of each finding. Paths become relative or absolute URI references as they are. A
// fingerprint names a finding by its code and the text of its line, so that lines that are inserted elsewhere
// do not change it; of equal ones it counts their order in the file.
std::string renderSarif(const Diagnostics& diagnostics, const SourceMap& sources,
                        const std::vector<SarifRule>& rules);

} // namespace dotek
