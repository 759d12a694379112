// Flat code as statements of the IR, without what no path reaches.
#pragma once

#include "frontend/gibbs/LowerWalk.h"

#include <functional>
#include <vector>

namespace dotek::frontend::gibbs {

// A statement; `target` is the step that a jump or branch goes to, the number of steps for the end. A mark is
// no statement but the place `target`, above the number of steps: two for each step may be made.
struct Emitted {
  ir::CycleStatement statement;
  std::size_t target = kNowhere;
  bool mark = false;
};

struct EmitOptions {
  std::set<std::size_t> alarms; // messages that are alarms; others are comments
  bool unsetZero = false;
  // Statements of a move.
  std::function<std::vector<Emitted>(std::size_t step, const FlatMove& move)> move;
};

ir::CycleStatement statementOf(decltype(ir::CycleStatement::node) node, SourceRange range,
                               std::string reason = "");

std::vector<ir::CycleStatement> emitStatements(const Flat& flat, const WalkResult& walk,
                                               const EmitOptions& options, ir::Cycle& cycle);

// A reached step from which no path leads out; kNowhere: there is none.
std::size_t endlessStep(const Flat& flat, const WalkResult& walk, const std::set<std::size_t>& alarms);

} // namespace dotek::frontend::gibbs
