// The lines in which two texts differ.
#pragma once

#include <string>
#include <string_view>

namespace dotek::cli {

// In the form of `diff -u` without lines around the changes; "" for equal texts. Ends of lines by CR LF count
// as LF. Texts whose changed part is very long are shown as one change.
std::string lineDiff(const std::string& name, std::string_view before, std::string_view after);

} // namespace dotek::cli
