#include "lint/Turning.h"

#include <cmath>

namespace dotek::lint {

bool isForLathe(const Project& project) {
  return project.control != nullptr && project.control->turning.has_value();
}

const ir::Word* wordOf(const ir::NcBlock& block, const stdlib::Control& control, stdlib::Function function) {
  for (const ir::Word& word : block.words) {
    const double* value = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
    if (value == nullptr || !(*value >= 0 && *value < 1000)) continue;
    const stdlib::CodeInfo* code = control.find('G', static_cast<std::uint32_t>(std::lround(*value * 10)));
    if (code != nullptr && code->function == function) return &word;
  }
  return nullptr;
}

} // namespace dotek::lint
