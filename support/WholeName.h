// One name for a file, whatever a command line or an editor calls it.
#pragma once

#include <string>
#include <string_view>

namespace dotek {

// Absolute, without `.` and `..`, with `/`; links are not followed. The path as it is where the system does
// not say in which folder the process runs.
std::string wholeName(const std::string& path);
// The path without `./` before it, which code hosts do not know.
std::string_view withoutDot(std::string_view path);

} // namespace dotek
