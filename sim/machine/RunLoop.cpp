// The limit of steps: a run that meets it goes round in a loop, and its end names that loop.
#include "ir/Walk.h"
#include "sim/machine/Run.h"
#include "sim/machine/Value.h"
#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace dotek::sim {
namespace {

// The last steps, which are followed: enough for some rounds of a loop that holds others.
constexpr std::uint64_t kMostFollowed = 1'000'000;

} // namespace

void Run::keepFuel() {
  followed_ = std::min<std::uint64_t>(kMostFollowed, limits_.simSteps / 2) / 2;
  fuel_ = limits_.simSteps - 2 * followed_;
}

bool Run::spend(std::uint32_t steps) {
  if (fuel_ > steps) {
    fuel_ -= steps;
    return true;
  }
  // The last steps come in two halves: the first finds the loop, the second what it never changes.
  if (followed_ > steps && !trail_) {
    trail_.emplace();
    fuel_ = followed_;
    return true;
  }
  if (followed_ > steps && !asked_) {
    asked_ = AskedLoop();
    if ((asked_->edge = trail_->outermost())) watchLoop(*asked_);
    trail_->forget();
    fuel_ = followed_;
    return true;
  }
  fuel_ = 0;
  endInLoop();
  const bool anew = loop_ && code_.instructions[place_].op == Op::Exit && levels_.size() == 1;
  return machine_.overLimit(fmt::format(
      "the program took more than {} steps{}; `--limit sim-steps=N` allows more", limits_.simSteps,
      anew ? "; `M99` of a main program goes back to its beginning, so that it goes on for ever, as for one "
             "part after another; a run of one part needs `M30` there"
           : ""));
}

// Of a loop that WHILE and DO begin it is their block, else the one that jumps back.
const ir::ProgramStatement& Run::headOf(std::uint32_t place) const {
  const std::vector<ir::ProgramStatement>& body = code_.routineOf(place).program->body;
  std::size_t at = code_.statements[place], open = 0;
  if (!std::holds_alternative<ir::LoopEnd>(body[at].node)) return body[at];
  for (std::size_t i = at; i-- > 0;) {
    if (std::holds_alternative<ir::LoopEnd>(body[i].node)) ++open;
    if (std::holds_alternative<ir::Loop>(body[i].node) && open-- == 0) return body[i];
  }
  return body[at];
}

// What decides that it ends: its own condition, and those of the jumps that lead out of it.
void Run::watchLoop(AskedLoop& loop) const {
  const auto [from, to] = *loop.edge;
  const CellLayout& layout = machine_.layout();
  std::set<std::uint32_t> cells;
  const auto take = [&](const ir::ProgramStatement& statement) {
    const ir::ConditionPtr* const condition = ir::conditionOf(statement);
    if (condition == nullptr || *condition == nullptr) return;
    ir::eachNode(*condition, [&](const ir::Expression& node) {
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      if (variable == nullptr) return;
      const double* number = ir::constantValue(variable->number);
      const bool fits = number != nullptr && *number >= 1 && *number <= UINT32_MAX;
      const std::uint32_t cell =
          fits ? layout.cellOf(static_cast<std::uint32_t>(*number)) : CellLayout::kNone;
      if (cell == CellLayout::kNone)
        loop.changes = true; // or may do so
      else
        cells.insert(cell);
    });
  };
  take(headOf(from));
  for (std::uint32_t at = to; at <= from; ++at)
    switch (code_.instructions[at].op) {
    case Op::JumpLess:
    case Op::JumpGreater:
    case Op::JumpLessEqual:
    case Op::JumpGreaterEqual:
    case Op::JumpSame:
    case Op::JumpDifferent:
    case Op::JumpTrue:
    case Op::JumpFalse:
      if (code_.instructions[at].c < to || code_.instructions[at].c > from) take(code_.statementOf(at));
      break;
    default: break;
    }
  for (const std::uint32_t cell : cells)
    loop.values.push_back({cell, cells_[cell]});
}

void Run::followLoop() {
  trail_->step(levels_.size(), place_);
  if (!asked_ || !asked_->edge || trail_->taken() != asked_->edge) return;
  ++asked_->rounds;
  for (const auto& [cell, value] : asked_->values)
    asked_->changes =
        asked_->changes || isNull(cells_[cell]) != isNull(value) || (!isNull(value) && cells_[cell] != value);
}

void Run::endInLoop() {
  const std::optional<LoopTrail::Edge> edge = trail_ ? trail_->outermost() : std::nullopt;
  if (!edge) return;
  EndlessLoop& out = *(loop_ = EndlessLoop());
  out.head = &headOf(edge->from);
  if (asked_ && asked_->edge == edge && asked_->rounds > 1 && !asked_->changes)
    for (const auto& [cell, value] : asked_->values)
      out.constant.emplace_back(machine_.layout().numberOf(cell), value);
  for (; levels_.size() > trail_->depth(); levels_.pop_back())
    machine_.leave();
  place_ = edge->from;
  machine_.frame().line = code_.lines[place_];
}

std::string Run::loopText() const {
  if (!loop_) return "";
  std::string out;
  for (const auto& [number, value] : loop_->constant)
    out += fmt::format("{}#{} stays {}", out.empty() ? "" : ", ", number,
                       isNull(value) ? "empty" : numberText(value));
  return out.empty()
             ? "the program goes round in this loop"
             : "the program goes round in this loop, and nothing on which its end depends changes: " + out;
}

} // namespace dotek::sim
