// Names of the numbers in a `.cnc` file. "": not known.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dotek::posts::cnc {

std::string_view movementName(std::uint32_t number);
std::string_view commandName(std::uint32_t number);
std::string_view coolantName(std::uint32_t number);
std::string_view sectionTypeName(std::uint32_t number);
// `text`: the parameter `operation:tool_type`, asked where the number is in no file that was read.
std::string_view toolTypeName(std::uint32_t number, std::string_view text);

} // namespace dotek::posts::cnc
