// The lines in which two texts differ.
#pragma once

#include <string>
#include <string_view>

namespace dotek::cli {

// In the form of `diff -u`, as a patch of which nothing is lost: lines keep the ends they have in the texts,
// though CR LF and LF count as equal. "" for equal texts. Texts whose changed part is very long are shown as
// one change. `terminal`: for an eye, without what would steer it.
std::string lineDiff(const std::string& name, std::string_view before, std::string_view after, bool terminal);

} // namespace dotek::cli
