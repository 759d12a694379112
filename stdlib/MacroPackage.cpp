#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"

#include <optional>

namespace dotek::stdlib {

MacroSet packaged(const MacroSet& set, const MacroPackage& package) {
  constexpr std::uint32_t kFirst = 100, kLast = 149, kFirstKept = 500;
  const auto moved = [&](std::uint32_t number) {
    if (number >= kFirst && number <= kLast) return number + package.shift;
    if (number >= kFirstKept) return package.calibrationFirst + (number - kFirstKept);
    return number;
  };
  const auto move = [&](auto& number) {
    if (number) number = moved(*number);
  };
  MacroSet out = set;
  out.title = package.title;
  for (auto* ranges : {&out.scratch, &out.overwritten})
    for (auto& [first, last] : *ranges) {
      const bool kept = first >= kFirstKept;
      first = kept ? package.calibrationFirst : moved(first);
      last = kept ? package.calibrationLast : moved(last);
    }
  for (MacroSignature& signature : out.signatures) {
    for (MacroResult& result : signature.results)
      result.variable = moved(result.variable);
    for (MacroArgument& argument : signature.arguments)
      if (argument.extendedFirst != 0) {
        argument.extendedFirst = package.extendedFirst;
        argument.extendedLast = package.extendedLast;
        argument.extendedStep = package.extendedStep;
      }
  }
  ProbingFacts& facts = out.probing;
  move(facts.feedVariable);
  move(facts.offsetX);
  move(facts.offsetY);
  move(facts.vectorFirst);
  move(facts.vectorLast);
  facts.radiusX = package.radiusX;
  facts.radiusY = package.radiusY;
  for (auto& [number, value] : out.callerValues)
    number = moved(number);
  return out;
}

} // namespace dotek::stdlib
