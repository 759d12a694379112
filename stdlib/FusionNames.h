// What the engine of Fusion gives to a post: fusion/names.toml.
#pragma once

#include "stdlib/DataFiles.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

struct FusionNames {
  struct Family {
    std::string name;
    std::vector<std::string> names; // constants; Dotek's value of each is its place
  };

  std::set<std::string, std::less<>> entries, hooks, functions, variables, classes, javascript, valued;
  std::vector<Family> families;
  std::set<std::string, std::less<>> all; // all of these

  static FusionNames load(const DataFiles& files);
};

} // namespace dotek::stdlib
