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
};

// `rules` holds the code of each finding. Paths become relative or absolute URI references as they are.
std::string renderSarif(const Diagnostics& diagnostics, const SourceMap& sources,
                        const std::vector<SarifRule>& rules);

} // namespace dotek
