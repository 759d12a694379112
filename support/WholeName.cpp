#include "support/WholeName.h"

#include <filesystem>
#include <system_error>

namespace dotek {

std::string wholeName(const std::string& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return (error ? std::filesystem::path(path) : whole).lexically_normal().generic_string();
}

std::string_view withoutDot(std::string_view path) {
  while (path.starts_with("./"))
    path.remove_prefix(2);
  return path;
}

} // namespace dotek
