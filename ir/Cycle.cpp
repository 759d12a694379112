#include "ir/Cycle.h"

#include <utility>

namespace dotek::ir {

VariableId Cycle::add(Variable variable) {
  variables.push_back(std::move(variable));
  return static_cast<VariableId>(variables.size() - 1);
}

LabelId Cycle::addLabel(LabelName label) {
  // Somebody may have filled `labels` by hand.
  for (; labelsSeen < labels.size(); ++labelsSeen)
    labelNames.try_emplace(labels[labelsSeen].name, 2);
  const std::string base = label.name;
  while (!labelNames.try_emplace(label.name, 2).second)
    label.name = base + "_" + std::to_string(labelNames[base]++);
  labels.push_back(std::move(label));
  labelsSeen = labels.size();
  return static_cast<LabelId>(labels.size() - 1);
}

} // namespace dotek::ir
