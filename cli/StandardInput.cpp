#include "cli/StandardInput.h"

#include "support/Files.h"
#include "support/WholeName.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace dotek::cli {

bool takeStandardInput(Arguments& arguments, Diagnostics& diagnostics) {
  if (arguments.standardInputName.empty()) return true;
  std::optional<std::string> text = readBytes("-", arguments.common.limits, diagnostics);
  if (!text) return false;
  std::map<std::string, std::string> buffers;
  buffers.emplace(wholeName(arguments.standardInputName), std::move(*text));
  arguments.common.buffers = std::make_shared<const std::map<std::string, std::string>>(std::move(buffers));
  std::replace(arguments.inputs.begin(), arguments.inputs.end(), std::string("-"),
               arguments.standardInputName);
  return true;
}

} // namespace dotek::cli
