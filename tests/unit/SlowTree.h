// What the slow evaluator asks of a tree before it runs: which DO belongs to which END, and how deep brackets
// nest.
#pragma once

#include "frontend/macrob/Ast.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dotek::tests {

// A program and the loops of its blocks.
struct Routine {
  const frontend::macrob::Program* program = nullptr;
  std::vector<std::size_t> partner;            // END of a DO, DO of an END; kNone: it has none
  std::vector<std::vector<std::size_t>> loops; // DO blocks around a block, outer first; END is inside
  static constexpr std::size_t kNone = SIZE_MAX;
};

Routine routineOf(const frontend::macrob::Program& program);

// Number of a loop; 0: it has none.
std::uint32_t loopNumber(const std::optional<frontend::macrob::LoopNumber>& loop);

// Brackets inside one another, those of functions and of #[..] included.
std::uint32_t depth(const frontend::macrob::Expression& expression);
std::uint32_t depth(const frontend::macrob::Condition& condition);

} // namespace dotek::tests
