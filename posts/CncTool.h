// A tool of a `.cnc` file as the kernel takes it.
#pragma once

#include "posts/Cnc.h"

#include <string>
#include <utility>
#include <vector>

namespace dotek::posts {

struct CncTool {
  const cnc::Tool& tool;
  std::string typeText;                                          // the parameter `operation:tool_type`
  std::vector<std::pair<std::string_view, std::string>> members; // beyond its record, as JSON

  // "" with a fault: it has a number that is not known.
  std::string json(std::string& fault) const;
};

} // namespace dotek::posts
