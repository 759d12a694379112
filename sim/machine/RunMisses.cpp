// Follows values that come from where a skip move has ended that met nothing, through cells and calls.
#include "sim/machine/Run.h"
#include "sim/machine/Value.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace dotek::sim {

void Run::watchMisses(MissWatcher* watcher) {
  misses_ = watcher;
  fromMiss_.assign(cellCount_, 0);
  argumentMisses_.assign(locals_.size(), 0);
}

// Which miss the value of a cell comes from.
std::uint32_t Run::missOf(std::uint32_t cell) const {
  return cell < fromMiss_.size() ? fromMiss_[cell] : 0;
}

std::uint32_t Run::missOfVariable(double number) const {
  const double whole = std::round(nullAsZero(number));
  if (!(whole >= 0 && whole < 1e9)) return 0;
  const auto n = static_cast<std::uint32_t>(whole);
  const std::uint32_t cell = machine_.layout().cellOf(n);
  return cell == CellLayout::kNone ? misses_->missIn(n) : missOf(cell);
}

// Before the instruction is carried out.
void Run::followMiss(const Instruction& at) {
  switch (at.op) {
  case Op::Copy:
  case Op::Number:
  case Op::Sine:
  case Op::Cosine:
  case Op::SquareRoot:
  case Op::Unary:
  case Op::NegateGiven:
  case Op::ToIncrement: fromMiss_[at.c] = missOf(at.a); return;
  case Op::Add:
  case Op::Subtract:
  case Op::Multiply:
  case Op::Divide:
  case Op::Binary: fromMiss_[at.c] = std::max(missOf(at.a), missOf(at.b)); return;
  case Op::Read: fromMiss_[at.c] = misses_->missIn(at.a); return;
  case Op::ReadAt: fromMiss_[at.c] = missOfVariable(cells_[at.a]); return;
  case Op::Test:
  case Op::And:
  case Op::Or:
  case Op::Not:
  case Op::Place: fromMiss_[at.c] = 0; return;
  case Op::Write: missInHand_ = missOf(at.b); return;
  case Op::WriteAt: {
    missInHand_ = missOf(at.b);
    const double whole = std::round(nullAsZero(cells_[at.a]));
    if (!(whole >= 1 && whole < 1e9)) return;
    const std::uint32_t cell = machine_.layout().cellOf(static_cast<std::uint32_t>(whole));
    if (cell < fromMiss_.size()) fromMiss_[cell] = missInHand_;
    return;
  }
  case Op::Block: {
    missInHand_ = 0;
    const BlockSlots& slots = code_.blocks[at.a];
    for (std::uint32_t i = 0; i < slots.words; ++i)
      missInHand_ = std::max(missInHand_, missOf(code_.words[slots.firstWord + i].cell));
    return;
  }
  case Op::Call: {
    const CallSlots& slots = code_.calls[at.a];
    std::fill(argumentMisses_.begin(), argumentMisses_.end(), 0);
    for (std::uint32_t i = 0; i < slots.arguments; ++i) {
      const ArgumentSlot& argument = code_.arguments[slots.firstArgument + i];
      if (argument.local < argumentMisses_.size()) argumentMisses_[argument.local] = missOf(argument.cell);
    }
    return;
  }
  default: return;
  }
}

// After a block.
void Run::checkShift() {
  if (!followsMisses_) return;
  for (std::uint32_t i = 0; i < words_.gCount; ++i) {
    const stdlib::CodeInfo* const code = control_.find('G', words_.g[i]);
    if (code == nullptr) continue;
    if (code->function == stdlib::Function::SetPosition)
      misses_->placeSet((words_.has('X') ? 1U : 0U) | (words_.has('Y') ? 2U : 0U) |
                        (words_.has('Z') ? 4U : 0U));
    if (missInHand_ != 0 &&
        (code->function == stdlib::Function::LocalShift || code->function == stdlib::Function::SetPosition ||
         code->function == stdlib::Function::RotationOn))
      misses_->shiftedBy(missInHand_);
  }
}

// A macro with text begins: its locals are those of the call.
void Run::enterMisses() {
  if (!followsMisses_) return;
  const auto locals = static_cast<std::ptrdiff_t>(argumentMisses_.size());
  savedMisses_.emplace_back(fromMiss_.begin(), fromMiss_.begin() + locals);
  std::copy(argumentMisses_.begin(), argumentMisses_.end(), fromMiss_.begin());
}

// It ends. What was entered before the first miss holds nothing of one.
void Run::leaveMisses() {
  if (!followsMisses_) return;
  const auto locals = static_cast<std::ptrdiff_t>(argumentMisses_.size());
  if (savedMisses_.empty()) {
    std::fill(fromMiss_.begin(), fromMiss_.begin() + locals, 0);
    return;
  }
  std::copy(savedMisses_.back().begin(), savedMisses_.back().end(), fromMiss_.begin());
  savedMisses_.pop_back();
}

// Around a macro without text: common variables that it sets hold its own results.
std::vector<std::pair<std::uint32_t, double>> Run::valuesOfMisses() const {
  std::vector<std::pair<std::uint32_t, double>> out;
  if (!followsMisses_) return out;
  for (std::uint32_t cell = machine_.layout().locals() + 1; cell < machine_.layout().size(); ++cell)
    if (fromMiss_[cell] != 0) out.emplace_back(cell, cells_[cell]);
  return out;
}

void Run::forgetChanged(const std::vector<std::pair<std::uint32_t, double>>& before) {
  for (const auto& [cell, value] : before)
    if (std::bit_cast<std::uint64_t>(cells_[cell]) != std::bit_cast<std::uint64_t>(value))
      fromMiss_[cell] = 0;
}

} // namespace dotek::sim
