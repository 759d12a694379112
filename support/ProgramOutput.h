// What another program prints, such as a version control.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dotek {

// Runs `command`, found by PATH, without input, and gives its standard output. nullopt: it could not be
// started, printed more than `most` bytes, or ended with another status than 0; `why` has the first line of
// what it wrote to standard error, or what the system says.
std::optional<std::string> outputOfProgram(const std::vector<std::string>& command, std::size_t most,
                                           std::string& why);

} // namespace dotek
