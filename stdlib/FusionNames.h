// What the engine of Fusion gives to a post: fusion/names.toml.
#pragma once

#include "stdlib/DataFiles.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

struct FusionNames {
  struct Family {
    std::string name;
    std::vector<std::string> names;    // constants
    std::vector<std::uint32_t> values; // of each
  };

  std::set<std::string, std::less<>> entries, hooks, functions, variables, classes, javascript, valued;
  std::set<std::string, std::less<>> absent; // of variables and classes: what the kernel does not carry out
  std::vector<Family> families;
  std::set<std::string, std::less<>> all; // all of these

  static FusionNames load(const DataFiles& files);
};

} // namespace dotek::stdlib
