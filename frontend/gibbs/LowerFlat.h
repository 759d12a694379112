// A macro as straight code with jumps: calls, loops and blocks are resolved, what the CAM knows is a host
// input, and what only leads to other data (numbers of tools, texts) is gone.
#pragma once

#include "frontend/gibbs/Run.h"
#include "ir/Cycle.h"

#include <array>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace dotek::frontend::gibbs {

struct FlatAssign {
  ir::VariableId variable = 0;
  ir::ExpressionPtr value;
};
// From here on the variable has no value.
struct FlatUnset {
  ir::VariableId variable = 0;
};
// Goes to `target` where the condition holds, else on.
struct FlatBranch {
  ir::ConditionPtr condition;
  std::size_t target = 0;
};
struct FlatJump {
  std::size_t target = 0;
};
struct FlatMessage {
  std::string text;      // UTF-8; constant parts only
  bool computed = false; // a part that is no constant is left out
};
// A dialog that was not shown before: what was shown up to here is past.
struct FlatDialog {};
struct FlatMove {
  PathMove::Kind kind = PathMove::Kind::Feed;
  std::array<ir::ExpressionPtr, 3> axes; // as written; null pointer: not written
};
// The macro ends: the values pass, or are rejected.
struct FlatEnd {
  bool rejects = false;
  bool again = false; // by a macro that calls itself and shows its dialog a second time
};
// The macro ends with what its return code says; not set: it passes.
struct FlatReturn {
  ir::VariableId code = 0;
};
// Reached only: cannot be translated.
struct FlatRefuse {
  Diagnostic diagnostic;
};

struct FlatStep {
  SourceRange range;
  std::variant<FlatAssign, FlatUnset, FlatBranch, FlatJump, FlatMessage, FlatDialog, FlatMove, FlatEnd,
               FlatReturn, FlatRefuse>
      step;
};

inline constexpr ir::VariableId kNoVariable = std::numeric_limits<ir::VariableId>::max();

// Targets are indices of `steps`; each path ends in an End, a Return or a Refuse.
struct Flat {
  std::vector<FlatStep> steps;
  ir::VariableId returnCode = kNoVariable;
};

} // namespace dotek::frontend::gibbs
