#include "stdlib/SearchTravel.h"

namespace dotek::stdlib {

bool travelIsSearch(const MacroSignature& signature, const MacroArgument& argument) {
  return signature.intent == Intent::Surface && argument.role == ArgumentRole::Target &&
         argument.frame == ir::Frame::Here && signature.find(ArgumentRole::Overtravel) == nullptr;
}

bool travelIsSearch(const MacroSignature& signature, ir::Axis axis) {
  const MacroArgument* const target = signature.find(ArgumentRole::Target, axis);
  return target != nullptr && travelIsSearch(signature, *target);
}

} // namespace dotek::stdlib
