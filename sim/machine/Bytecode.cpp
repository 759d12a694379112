#include "sim/machine/Bytecode.h"

#include <algorithm>

namespace dotek::sim {

const Routine* Bytecode::find(std::uint64_t number) const {
  const auto at = std::lower_bound(byNumber.begin(), byNumber.end(), number,
                                   [&](std::uint32_t i, std::uint64_t n) { return routines[i].number < n; });
  return at == byNumber.end() || routines[*at].number != number ? nullptr : &routines[*at];
}

const Routine& Bytecode::routineOf(std::uint32_t place) const {
  const auto behind = std::upper_bound(routines.begin(), routines.end(), place,
                                       [](std::uint32_t p, const Routine& one) { return p < one.begin; });
  return *(behind - 1);
}

const ir::ProgramStatement& Bytecode::statementOf(std::uint32_t place) const {
  return routineOf(place).program->body[statements[place]];
}

const NumberedPlace* Bytecode::search(const Routine& routine, std::uint32_t place,
                                      std::uint64_t number) const {
  const auto less = [](const NumberedPlace& one, std::uint64_t n) { return one.number < n; };
  const auto first = std::lower_bound(routine.labels.begin(), routine.labels.end(), number, less);
  if (first == routine.labels.end() || first->number != number) return nullptr;
  for (auto at = first; at != routine.labels.end() && at->number == number; ++at)
    if (at->place > place) return &*at;
  return &*first;
}

bool Bytecode::entersLoop(std::uint32_t from, std::uint32_t to) const {
  if (to == 0) return false;
  for (; from != 0; from = outerLoops[from])
    if (from == to) return false;
  return true;
}

} // namespace dotek::sim
