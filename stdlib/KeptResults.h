// What a protected move leaves of the results of the measurement before it.
#pragma once

#include "stdlib/MacroSet.h"

#include <vector>

namespace dotek::stdlib {

// A protected move whose results the set states writes those alone; of one that states none nothing is known.
inline bool keepsResults(const MacroSignature& signature) {
  return signature.intent == Intent::ProtectedMove && !signature.results.empty();
}
inline bool moveKeepsResults(const MacroSet& set) {
  const MacroSignature* const move = set.find(Intent::ProtectedMove);
  return move != nullptr && keepsResults(*move);
}

// By variable: what the calls leave that measure, its errors excepted.
inline std::vector<bool> measuredVariables(const MacroSet& set) {
  std::vector<bool> out;
  for (const MacroSignature& signature : set.signatures)
    for (const MacroResult& result : signature.results) {
      if (result.output == Output::OutOfTolerance || result.output == Output::ProbeError) continue;
      if (out.size() <= result.variable) out.resize(result.variable + 1);
      out[result.variable] = true;
    }
  return out;
}

} // namespace dotek::stdlib
