// What the dialog of a cycle offers for its fields.
#pragma once

#include "ir/Cycle.h"
#include "project/CycleFolder.h"
#include "support/Source.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::targets {

// A value that a field may have, and what the dialog says of it.
struct DialogChoice {
  double value = 0;
  std::string title; // UTF-8
};

// Of each parameter of `cycle` that the dialog of `folder` offers as a list, or as a check box (0 and 1), in
// its order. Other parameters are absent.
std::map<ir::VariableId, std::vector<DialogChoice>>
dialogChoices(const project::CycleFolder& folder, const ir::Cycle& cycle, const SourceMap& sources);

// Of a parameter of the cycle language, by its type as a page of the cycle names it ("flag", "choice of a,
// b"); none of other types.
std::vector<DialogChoice> choicesOfType(std::string_view type);

} // namespace dotek::targets
