// Constants along the control flow of a statement list.
#pragma once

#include "ir/Evaluate.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

namespace dotek::ir {

// What is known of the variables at the entry of a list, at each label that is reached, and at its end.
// Entries are Known, Null or Unknown ("it varies").
struct Constants {
  Environment entry;
  std::unordered_map<std::size_t, Environment>
      atLabel;                      // by index of the Label statement; absent: unreachable
  std::optional<Environment> atEnd; // nothing: no path ends there
  // Of a list too large to follow its paths: holds at every label, and each counts as reached.
  std::optional<Environment> atOthers;
};
Constants propagate(const std::vector<CycleStatement>& list, Environment entry);

// The list under these constants: what is known put in, decided branches and unreachable statements gone.
std::vector<CycleStatement> specialised(const std::vector<CycleStatement>& list, const Constants& constants);

// The statements in the order in which they run from `entry`, so that nothing goes back: loops whose rounds
// are decided are written out, and a branch that is not decided goes forward to a label of its own. Nothing:
// how often something runs is not decided, or there are more than `maxSteps`. `newLabel`: another one like
// it.
struct Unrolled {
  std::vector<CycleStatement> statements;
  std::optional<Environment> atEnd; // nothing: it ends in an alarm
};
std::optional<Unrolled> unroll(const std::vector<CycleStatement>& list, Environment entry,
                               std::uint32_t maxSteps, const std::function<LabelId(LabelId)>& newLabel);

} // namespace dotek::ir
