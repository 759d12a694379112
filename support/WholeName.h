// One name for a file, whatever a command line or an editor calls it.
#pragma once

#include <string>

namespace dotek {

// Absolute, without `.` and `..`, with `/`; links are not followed. The path as it is where the system does
// not say in which folder the process runs.
std::string wholeName(const std::string& path);

} // namespace dotek
