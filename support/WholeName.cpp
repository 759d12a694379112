#include "support/WholeName.h"

#include <filesystem>
#include <system_error>

namespace dotek {

std::string wholeName(const std::string& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return (error ? std::filesystem::path(path) : whole).lexically_normal().generic_string();
}

} // namespace dotek
