#include "cli/StandardInput.h"

#include "support/Files.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

namespace dotek::cli {

bool takeStandardInput(Arguments& arguments, Diagnostics& diagnostics) {
  if (arguments.standardInputName.empty()) return true;
  std::optional<std::string> text = readBytes("-", arguments.common.limits, diagnostics);
  if (!text) return false;
  std::error_code error;
  const auto path = std::filesystem::absolute(arguments.standardInputName, error).lexically_normal();
  std::map<std::string, std::string> buffers;
  buffers.emplace(path.generic_string(), std::move(*text));
  arguments.common.buffers = std::make_shared<const std::map<std::string, std::string>>(std::move(buffers));
  std::replace(arguments.inputs.begin(), arguments.inputs.end(), std::string("-"),
               arguments.standardInputName);
  return true;
}

} // namespace dotek::cli
