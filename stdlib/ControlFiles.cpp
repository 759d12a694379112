#include "stdlib/ControlFiles.h"

#include <filesystem>

namespace dotek::stdlib {

bool isDataPath(std::string_view name) {
  return name.find('/') != std::string_view::npos || name.ends_with(".toml");
}

std::string besideFile(const std::string& file, const std::string& path) {
  return (std::filesystem::path(file).parent_path() / path).lexically_normal().generic_string();
}

} // namespace dotek::stdlib
