// Controls that are named by the path of their file: `--control ./mine.toml`. DataFiles::addFolder takes such
// a path as it takes a folder.
#pragma once

#include <string>
#include <string_view>

namespace dotek::stdlib {

// The name is a path: it has a slash, or ends with .toml.
bool isDataPath(std::string_view name);

// A path that the file names, seen from its folder.
std::string besideFile(const std::string& file, const std::string& path);

} // namespace dotek::stdlib
