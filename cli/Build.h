// What this build was made from.
#pragma once

#include <string_view>

namespace dotek::cli {

// Ten digits of the commit, with a `+` where sources differed from it; "not known" of sources without a
// history.
std::string_view builtCommit();
// Ten digits that are others when a built-in data file is another.
std::string_view dataVersion();

} // namespace dotek::cli
