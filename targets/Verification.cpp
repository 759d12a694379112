#include "targets/Verification.h"

namespace dotek::targets {

void TargetRun::differs(verify::Aspect aspect, std::string text, std::string line) {
  differsAt(aspect, std::move(text), 0);
  differences.back().text = std::move(line);
}

void TargetRun::differsAt(verify::Aspect aspect, std::string text, std::uint32_t line) {
  TargetDifference& one = differences.emplace_back();
  one.difference.aspect = aspect;
  one.difference.text = std::move(text);
  one.line = line;
}

} // namespace dotek::targets
