// Follows values that come from where a skip move has ended that met nothing, through cells and calls.
#include "ir/Evaluate.h"
#include "ir/Extremes.h"
#include "ir/Flow.h"
#include "ir/Walk.h"
#include "sim/machine/Run.h"
#include "sim/machine/Value.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace dotek::sim {
namespace {

// Other places where the move might have ended: by which share of it before its end.
constexpr std::array kPlaces = {1.0, 0.75, 0.5, 0.25};

} // namespace

void Run::watchMisses(MissWatcher* watcher) {
  misses_ = watcher;
  fromMiss_.assign(cellCount_, {});
  argumentMisses_.assign(locals_.size(), {});
}

Run::FromMiss Run::fromMiss(std::uint32_t cell) const {
  return cell < fromMiss_.size() ? fromMiss_[cell] : FromMiss{};
}

// Of a system variable.
Run::FromMiss Run::ofVariable(std::uint32_t number) const {
  FromMiss out;
  out.miss = misses_->missIn(number);
  if (out.miss == 0) return out;
  const double way = misses_->wayIn(number);
  for (std::size_t i = 0; i < out.off.size(); ++i)
    out.off[i] = -way * kPlaces[i];
  return out;
}

Run::FromMiss Run::fromMissOf(double number) const {
  const double whole = std::round(nullAsZero(number));
  if (!(whole >= 0 && whole < 1e9)) return {};
  const auto n = static_cast<std::uint32_t>(whole);
  const std::uint32_t cell = machine_.layout().cellOf(n);
  return cell == CellLayout::kNone ? ofVariable(n) : fromMiss(cell);
}

// Of a result: the later of the two misses, and what the result would be off.
template <class Function>
Run::FromMiss Run::computed(const Instruction& at, bool both, Function function) const {
  const FromMiss a = fromMiss(at.a), b = both ? fromMiss(at.b) : FromMiss{};
  FromMiss out;
  out.miss = std::max(a.miss, b.miss);
  if (out.miss == 0) return out;
  const double x = nullAsZero(cells_[at.a]), y = both ? nullAsZero(cells_[at.b]) : 0;
  for (std::size_t i = 0; i < out.off.size(); ++i)
    out.off[i] = function(x + (a.miss == out.miss ? a.off[i] : 0), y + (b.miss == out.miss ? b.off[i] : 0)) -
                 function(x, y);
  return out;
}

template <class Holds> void Run::askMiss(const Instruction& at, bool both, Holds holds) {
  // Which of several values is the greatest is no question about the move.
  if (ir::keepsExtreme(code_.routineOf(place_).program->body, code_.statements[place_])) return;
  const FromMiss outcome = computed(at, both, [&](double x, double y) {
    return std::isfinite(x) && std::isfinite(y) ? (holds(x, y) ? 1.0 : 0.0) : std::nan("");
  });
  const ir::ProgramStatement& statement = code_.statementOf(place_);
  if (outcome.miss != 0) {
    // What is no number is not known, and may tell.
    const bool tells =
        std::any_of(outcome.off.begin(), outcome.off.end(), [](double one) { return one != 0; });
    misses_->askedAbout(outcome.miss, tells, statement.origin.range());
  } else if (misses_->isOpen() && leadsToAlarm(place_)) {
    misses_->passedAlarm(statement.origin.range());
  }
}

// An IF over `#3000=`, or one whose GOTO leads to such a block.
bool Run::leadsToAlarm(std::uint32_t place) {
  const std::vector<ir::ProgramStatement>& body = code_.routineOf(place).program->body;
  const std::size_t at = code_.statements[place];
  const auto* branch = std::get_if<ir::Branch>(&body[at].node);
  if (branch == nullptr) return false;
  const auto [known, isNew] = alarms_.try_emplace(&body[at], false);
  if (!isNew) return known->second;
  const auto from = [&](std::size_t i) {
    constexpr std::size_t kNear = 6; // statements: the way to a safe place comes first
    for (std::size_t n = 0; i < body.size() && n < kNear; ++i, ++n) {
      if (std::holds_alternative<ir::Raise>(body[i].node)) return true;
      const bool leaves = std::holds_alternative<ir::Exit>(body[i].node) || ir::endsProgram(body[i]);
      if (leaves || ir::conditionOf(body[i]) != nullptr || std::holds_alternative<ir::Jump>(body[i].node))
        return false;
    }
    return false;
  };
  known->second = at + 1 < body.size() && std::holds_alternative<ir::Raise>(body[at + 1].node);
  for (std::size_t i = 0; i < body.size() && !known->second; ++i)
    if (const auto* label = std::get_if<ir::Label>(&body[i].node);
        label != nullptr && label->label == branch->target)
      known->second = from(i + 1);
  return known->second;
}

// Before the instruction is carried out.
void Run::followMiss(const Instruction& at) {
  const auto binary = [&](auto function) { fromMiss_[at.c] = computed(at, true, function); };
  const auto single = [&](auto function) {
    fromMiss_[at.c] = computed(at, false, [&](double x, double) { return function(x); });
  };
  const auto value = [](const ir::Computed& result) { return result.ok() ? result.value : std::nan(""); };
  switch (at.op) {
  case Op::Copy:
  case Op::Number:
  case Op::ToIncrement: fromMiss_[at.c] = fromMiss(at.a); return;
  case Op::Sine: single([&](double x) { return value(ir::sine(x, ir::AngleUnit::Degrees)); }); return;
  case Op::Cosine: single([&](double x) { return value(ir::cosine(x, ir::AngleUnit::Degrees)); }); return;
  case Op::SquareRoot: single([](double x) { return std::sqrt(x); }); return;
  case Op::Unary:
    single([&](double x) { return value(compute(static_cast<ir::UnaryOp>(at.detail), x)); });
    return;
  case Op::NegateGiven: single([](double x) { return -x; }); return;
  case Op::Add: binary([](double x, double y) { return x + y; }); return;
  case Op::Subtract: binary([](double x, double y) { return x - y; }); return;
  case Op::Multiply: binary([](double x, double y) { return x * y; }); return;
  case Op::Divide: binary([](double x, double y) { return y == 0 ? std::nan("") : x / y; }); return;
  case Op::Binary:
    binary([&](double x, double y) { return value(compute(static_cast<ir::BinaryOp>(at.detail), x, y)); });
    return;
  case Op::Read: fromMiss_[at.c] = ofVariable(at.a); return;
  case Op::ReadAt: fromMiss_[at.c] = fromMissOf(cells_[at.a]); return;
  case Op::JumpLess: askMiss(at, true, [](double x, double y) { return x < y; }); return;
  case Op::JumpGreater: askMiss(at, true, [](double x, double y) { return x > y; }); return;
  case Op::JumpLessEqual: askMiss(at, true, [](double x, double y) { return x <= y; }); return;
  case Op::JumpGreaterEqual: askMiss(at, true, [](double x, double y) { return x >= y; }); return;
  case Op::JumpSame:
  case Op::JumpDifferent: askMiss(at, true, [](double x, double y) { return x == y; }); return;
  case Op::JumpTrue:
  case Op::JumpFalse: askMiss(at, false, [](double x, double) { return x != 0; }); return;
  case Op::Test:
    askMiss(at, at.detail != kIsNull, [&](double x, double y) {
      if (at.detail == kIsNull) return false;
      switch (static_cast<ir::Relation>(at.detail)) {
      case ir::Relation::Less: return x < y;
      case ir::Relation::Greater: return x > y;
      case ir::Relation::LessEqual: return x <= y;
      case ir::Relation::GreaterEqual: return x >= y;
      case ir::Relation::Same:
      case ir::Relation::Different:
      case ir::Relation::Equal:
      case ir::Relation::NotEqual: break;
      }
      return x == y;
    });
    fromMiss_[at.c] = {};
    return;
  case Op::And:
  case Op::Or:
  case Op::Not:
  case Op::Place: fromMiss_[at.c] = {}; return;
  case Op::Write: missInHand_ = missOf(at.b); return;
  case Op::WriteAt: {
    missInHand_ = missOf(at.b);
    const double whole = std::round(nullAsZero(cells_[at.a]));
    if (!(whole >= 1 && whole < 1e9)) return;
    const std::uint32_t cell = machine_.layout().cellOf(static_cast<std::uint32_t>(whole));
    if (cell < fromMiss_.size()) fromMiss_[cell] = fromMiss(at.b);
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
    std::fill(argumentMisses_.begin(), argumentMisses_.end(), FromMiss{});
    for (std::uint32_t i = 0; i < slots.arguments; ++i) {
      const ArgumentSlot& argument = code_.arguments[slots.firstArgument + i];
      if (argument.local < argumentMisses_.size()) argumentMisses_[argument.local] = fromMiss(argument.cell);
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
    std::fill(fromMiss_.begin(), fromMiss_.begin() + locals, FromMiss{});
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
    if (fromMiss_[cell].miss != 0) out.emplace_back(cell, cells_[cell]);
  return out;
}

void Run::forgetChanged(const std::vector<std::pair<std::uint32_t, double>>& before) {
  for (const auto& [cell, value] : before)
    if (std::bit_cast<std::uint64_t>(cells_[cell]) != std::bit_cast<std::uint64_t>(value))
      fromMiss_[cell] = {};
}

} // namespace dotek::sim
