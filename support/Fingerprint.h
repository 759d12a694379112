// Names for findings that stay when lines are inserted elsewhere: for SARIF, baselines and code hosts.
#pragma once

#include "support/Diagnostics.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace dotek {

// Of a place of a finding with this code: its code and the text of its line, blanks aside.
// "0123456789abcdef".
std::string fingerprintOf(std::string_view code, SourceRange place, const SourceMap& sources);

// Hashes code and text of the line that a finding begins on, blanks aside; of equal ones in a file it counts
// their order. Findings are given in the order of the diagnostics.
class Fingerprints {
public:
  // "0123456789abcdef:1"; the finding has a place.
  std::string of(const Diagnostic& finding, const SourceMap& sources);

private:
  std::map<std::pair<FileId, std::string>, std::uint32_t> seen_;
};

} // namespace dotek
