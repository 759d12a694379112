#include "sim/machine/Run.h"

#include "ir/Evaluate.h"
#include "sim/machine/Decimal8.h"
#include "sim/machine/Value.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace dotek::sim {

using ir::AngleUnit;
using ir::ArithmeticError;
using ir::BinaryOp;
using ir::Computed;
using ir::UnaryOp;
using stdlib::Alarm;

namespace {

bool isBits(BinaryOp op) {
  switch (op) {
  case BinaryOp::BitAnd:
  case BinaryOp::BitOr:
  case BinaryOp::BitXor:
  case BinaryOp::RoundedAnd:
  case BinaryOp::RoundedOr:
  case BinaryOp::RoundedXor: return true;
  case BinaryOp::Add:
  case BinaryOp::Subtract:
  case BinaryOp::Multiply:
  case BinaryOp::Divide:
  case BinaryOp::Modulo:
  case BinaryOp::Direction:
  case BinaryOp::ValueOr:
  case BinaryOp::RoundedModulo:
  case BinaryOp::Power:
  case BinaryOp::Bearing: break;
  }
  return false;
}

// Bit patterns tell null from numbers; there is no -0.
bool same(double a, double b) {
  return isNull(a) ? isNull(b) : a == b;
}

// `tie`: two numbers that lie no farther apart are equal, but for Same and Equal and their opposites.
bool test(ir::Relation relation, double a, double b, double tie) {
  switch (relation) {
  case ir::Relation::Same: return same(a, b);
  case ir::Relation::Different: return !same(a, b);
  case ir::Relation::Equal: return nullAsZero(a) == nullAsZero(b);
  case ir::Relation::NotEqual: return nullAsZero(a) != nullAsZero(b);
  case ir::Relation::Less: return nullAsZero(a) < nullAsZero(b) - tie;
  case ir::Relation::Greater: return nullAsZero(a) > nullAsZero(b) + tie;
  case ir::Relation::LessEqual: return nullAsZero(a) <= nullAsZero(b) + tie;
  case ir::Relation::GreaterEqual: return nullAsZero(a) >= nullAsZero(b) - tie;
  }
  return false;
}

// Bit 0: a is a cell that is read; bit 1: b is one.
unsigned operandsOf(Op op) {
  switch (op) {
  case Op::Copy:
  case Op::Number:
  case Op::Sine:
  case Op::Cosine:
  case Op::SquareRoot:
  case Op::Unary:
  case Op::NegateGiven:
  case Op::ToIncrement:
  case Op::ReadAt:
  case Op::JumpTrue:
  case Op::JumpFalse:
  case Op::Not:
  case Op::JumpTo:
  case Op::Exit:
  case Op::Raise:
  case Op::Given:
  case Op::Record: return 1;
  case Op::Write: return 2;
  case Op::Add:
  case Op::Subtract:
  case Op::Multiply:
  case Op::Divide:
  case Op::Binary:
  case Op::WriteAt:
  case Op::JumpLess:
  case Op::JumpGreater:
  case Op::JumpLessEqual:
  case Op::JumpGreaterEqual:
  case Op::JumpSame:
  case Op::JumpDifferent:
  case Op::Test:
  case Op::And:
  case Op::Or: return 3;
  case Op::Read:
  case Op::Jump:
  case Op::SkipDelete:
  case Op::Sequence:
  case Op::Block:
  case Op::Call:
  case Op::Notice:
  case Op::OpenPort:
  case Op::Print:
  case Op::Name:
  case Op::Refuse:
  case Op::End:
  case Op::Absolute:
  case Op::Place:
  case Op::JumpSignal:
  case Op::JumpMissed:
  case Op::CallPlace:
  case Op::LeavePlace:
  case Op::Pause:
  case Op::Fault:
  case Op::CountBlock:
  case Op::Act:
  case Op::Round: break;
  }
  return 0;
}

// What it comes to is put into the cell c.
bool setsCell(Op op) {
  switch (op) {
  case Op::Copy:
  case Op::Number:
  case Op::Sine:
  case Op::Cosine:
  case Op::SquareRoot:
  case Op::Unary:
  case Op::NegateGiven:
  case Op::ToIncrement:
  case Op::Add:
  case Op::Subtract:
  case Op::Multiply:
  case Op::Divide:
  case Op::Binary:
  case Op::Read:
  case Op::ReadAt:
  case Op::Test:
  case Op::And:
  case Op::Or:
  case Op::Not:
  case Op::Place: return true;
  default: return false;
  }
}

// Null is read as 0 there, or leaves a word of a block out: not a question about null, not what keeps it.
bool countsNull(const Instruction& instruction) {
  switch (instruction.op) {
  case Op::JumpSame:
  case Op::JumpDifferent:
  case Op::Given:
  case Op::Write:
  case Op::JumpTrue:
  case Op::JumpFalse:
  case Op::Exit:
  case Op::Record: return false;
  case Op::Test:
    return instruction.detail != kIsNull &&
           static_cast<ir::Relation>(instruction.detail) != ir::Relation::Same &&
           static_cast<ir::Relation>(instruction.detail) != ir::Relation::Different;
  default: return true;
  }
}

} // namespace

Run::Run(Machine& machine, const Bytecode& code, const Limits& limits, MacroMeaning* meaning)
    : machine_(machine), code_(code), limits_(limits), meaning_(meaning), control_(machine.control()) {
  keepFuel();
  machine_.setCallLimit(limits.callDepth);
  const std::uint32_t added = kTemporaries + static_cast<std::uint32_t>(code.constants.size());
  const std::uint32_t first = machine_.addCells(added);
  cellCount_ = first + added;
  cells_ = machine_.cells();
  std::copy(code.constants.begin(), code.constants.end(), cells_ + first + kTemporaries);
  locals_.assign(machine_.layout().locals() + 1, kNull);
  readEarly_.assign(code.instructions.size(), false);
}

void Run::run() {
  if (code_.routines.empty()) {
    machine_.finish();
    return;
  }
  Level main;
  main.routine = &code_.routines.front();
  levels_.push_back(main);
  place_ = main.routine->begin;
  if (main.routine->number <= UINT32_MAX)
    machine_.beginProgram(static_cast<std::uint32_t>(main.routine->number));
  const bool decimal = control_.arithmetic == stdlib::Arithmetic::Decimal8;
  for (bool goesOn = true; goesOn;) {
    followsMisses_ = followsMisses_ || (misses_ != nullptr && misses_->hasMisses());
    if (machine_.hasUnknown() || !unset_.empty() || followsMisses_ || !measured_.empty() || trail_ ||
        !writes_.empty() || (tie_ > 0 && machine_.hasTouched()))
      goesOn = decimal ? execute<true, true>() : execute<false, true>();
    else
      goesOn = decimal ? execute<true, false>() : execute<false, false>();
  }
}

bool Run::tiesHere() const {
  return tie_ > 0 && machine_.hasTouched() &&
         std::none_of(levels_.begin(), levels_.end(),
                      [&](const Level& level) { return untied_.contains(level.routine->number); });
}

bool Run::knows(std::uint32_t cell) {
  if (cell >= machine_.layout().size() || !isUnknown(cells_[cell])) return true;
  return refuse(
      fmt::format("#{} is read, and what a macro left there is not known", machine_.layout().numberOf(cell)));
}

void Run::noteWritten(std::uint32_t cell, bool done) {
  if (cell < watchedWrites_.size() && watchedWrites_[cell] != 0) keepWrite(cell, done);
}

void Run::noteUnsetCell(std::uint32_t cell) {
  const CellLayout& layout = machine_.layout();
  if (cell <= layout.locals() || cell >= layout.size() || !isFresh(cells_[cell])) return;
  noteUnset(layout.numberOf(cell));
}

// Before the instruction is carried out; what is read from a number that is computed follows in readAt().
void Run::followMeasured(const Instruction& at, unsigned operands) {
  if ((operands & 1) != 0) tellMeasured(at.a);
  if ((operands & 2) != 0) tellMeasured(at.b);
  if (setsCell(at.op)) measured_.erase(at.c);
}

bool Run::fail(ArithmeticError error, bool tangent, bool bits) {
  switch (error) {
  case ArithmeticError::DivisionByZero: return machine_.raise(Alarm::DivideByZero);
  case ArithmeticError::Overflow: return machine_.raise(Alarm::Overflow);
  case ArithmeticError::Domain:
    return machine_.raise(bits      ? Alarm::IntegerOverflow
                          : tangent ? Alarm::DivideByZero
                                    : Alarm::ArgumentRange);
  case ArithmeticError::None:
  case ArithmeticError::NoValue: break;
  }
  return refuse("what this computes is not known to Dotek");
}

bool Run::readAt(double number, double& value) {
  const double whole = std::round(nullAsZero(number));
  if (whole >= 1 && whole <= control_.locals) {
    value = cells_[static_cast<std::size_t>(whole)];
    return true;
  }
  if (!(whole >= 0 && whole < 1e9)) return machine_.raise(Alarm::NoSuchVariable);
  const auto n = static_cast<std::uint32_t>(whole);
  if (ahead_) noteRead(n);
  const std::optional<double> read = machine_.read(n);
  if (read && !unset_.empty() && n > control_.locals && isFresh(*read)) noteUnset(n);
  if (!read) return false;
  if (listener_ != nullptr) tellRead(n, *read);
  value = *read;
  return true;
}

bool Run::writeAt(double number, double value) {
  const double whole = std::round(nullAsZero(number));
  if (!(whole >= 0 && whole < 1e9)) return machine_.raise(Alarm::NoSuchVariable);
  const auto n = static_cast<std::uint32_t>(whole);
  if (ahead_ && expectsMotion_) noteWrite(n);
  noteWritten(machine_.layout().cellOf(n));
  if (!machine_.write(n, value)) return false;
  measured_.erase(machine_.layout().cellOf(n));
  if (listener_ != nullptr) tellWritten(n, value);
  return true;
}

// Runs until a block, a call or whatever else changes more than cells; false: the run has ended. The places
// of instructions are 32 bits; each list of instructions ends in an End.
template <bool kDecimal8, bool kWatched> bool Run::execute() {
  const Instruction* const all = code_.instructions.data();
  double* const cells = cells_;
  const Instruction* at = all + place_;
  std::uint64_t fuel = fuel_;
  const double tie = kWatched && tiesHere() ? tie_ : 0.0;
  const auto leave = [&] {
    place_ = static_cast<std::uint32_t>(at - all);
    machine_.frame().line = code_.lines[place_];
    fuel_ = fuel;
  };
  const auto number = [&](std::uint32_t cell) { return nullAsZero(cells[cell]); };
  // false: the result does not fit.
  const auto put = [&](double result) -> bool {
    if constexpr (kDecimal8) {
      result = toDecimal8(result);
      if (!fitsDecimal8(result)) return false;
    } else if (!(std::abs(result) <= std::numeric_limits<double>::max())) {
      return false;
    }
    cells[at->c] = result + 0.0; // no -0
    return true;
  };
  const auto overflow = [&] {
    leave();
    return fail(ArithmeticError::Overflow, false, false);
  };
  const auto jump = [&] {
    at = all + at->c;
    return --fuel != 0;
  };
  for (;;) {
    if constexpr (kWatched) {
      const unsigned operands = operandsOf(at->op);
      leave();
      if (((operands & 1) != 0 && !knows(at->a)) || ((operands & 2) != 0 && !knows(at->b))) return false;
      if (!unset_.empty() && countsNull(*at)) {
        if ((operands & 1) != 0) noteUnsetCell(at->a);
        if ((operands & 2) != 0) noteUnsetCell(at->b);
      }
      if (setsCell(at->op)) noteWritten(at->c);
      if (followsMisses_) followMiss(*at);
      if (!measured_.empty()) followMeasured(*at, operands);
      if (trail_) followLoop();
    }
    switch (at->op) {
    case Op::Copy: {
      const double value = cells[at->a];
      cells[at->c] = isNull(value) ? kNull : value;
      break;
    }
    case Op::Number: cells[at->c] = number(at->a); break;
    case Op::Add:
      if (!put(number(at->a) + number(at->b))) return overflow();
      break;
    case Op::Subtract:
      if (!put(number(at->a) - number(at->b))) return overflow();
      break;
    case Op::Multiply:
      if (!put(number(at->a) * number(at->b))) return overflow();
      break;
    case Op::Divide: {
      const double divisor = number(at->b);
      if (divisor == 0) {
        leave();
        return fail(ArithmeticError::DivisionByZero, false, false);
      }
      if (!put(number(at->a) / divisor)) return overflow();
      break;
    }
    case Op::Sine:
      if (!put(ir::sine(number(at->a), AngleUnit::Degrees).value)) return overflow();
      break;
    case Op::Cosine:
      if (!put(ir::cosine(number(at->a), AngleUnit::Degrees).value)) return overflow();
      break;
    case Op::SquareRoot: {
      const double a = number(at->a);
      if (a < 0) {
        leave();
        return fail(ArithmeticError::Domain, false, false);
      }
      if (!put(std::sqrt(a))) return overflow();
      break;
    }
    case Op::Unary: {
      const auto op = static_cast<UnaryOp>(at->detail);
      const Computed result = compute(op, number(at->a));
      if (!result.ok()) {
        leave();
        return fail(result.error, op == UnaryOp::Tangent, false);
      }
      if (!put(result.value)) return overflow();
      break;
    }
    case Op::Binary: {
      const auto op = static_cast<BinaryOp>(at->detail);
      const Computed result = compute(op, number(at->a), number(at->b));
      if (!result.ok()) {
        leave();
        return fail(result.error, false, isBits(op));
      }
      if (!put(result.value)) return overflow();
      break;
    }
    case Op::NegateGiven:
      if (isNull(cells[at->a])) {
        leave();
        return refuse("a minus before a variable without a value: whether the word is left out is not known");
      }
      cells[at->c] = 0 - cells[at->a];
      break;
    case Op::ToIncrement: {
      double value = number(at->a);
      leave();
      if (!toIncrement(static_cast<char>(at->detail), value)) return false;
      cells[at->c] = value;
      break;
    }
    case Op::Read: {
      leave();
      if (ahead_) noteRead(at->a);
      const std::optional<double> value = machine_.read(at->a);
      if (!value) return false;
      if (listener_ != nullptr) tellRead(at->a, *value);
      if (isNull(*value))
        cells[at->c] = kNull;
      else if (!put(*value))
        return overflow();
      break;
    }
    case Op::ReadAt: {
      leave();
      double value = 0;
      if (!readAt(cells[at->a], value)) return false;
      if (isNull(value))
        cells[at->c] = kNull;
      else if (!put(value))
        return overflow();
      break;
    }
    case Op::Write:
      leave();
      if (ahead_ && expectsMotion_) noteWrite(at->a);
      if (!machine_.write(at->a, cells[at->b])) return false;
      if (listener_ != nullptr) tellWritten(at->a, cells[at->b]);
      break;
    case Op::WriteAt:
      leave();
      if (!writeAt(cells[at->a], cells[at->b])) return false;
      break;
#define DOTEK_JUMP(condition)                                                                                \
  if (condition) {                                                                                           \
    if (jump()) continue;                                                                                    \
    leave();                                                                                                 \
    return spend(0);                                                                                         \
  }                                                                                                          \
  break
    case Op::JumpLess: DOTEK_JUMP(number(at->a) < number(at->b) - tie);
    case Op::JumpGreater: DOTEK_JUMP(number(at->a) > number(at->b) + tie);
    case Op::JumpLessEqual: DOTEK_JUMP(number(at->a) <= number(at->b) + tie);
    case Op::JumpGreaterEqual: DOTEK_JUMP(number(at->a) >= number(at->b) - tie);
    case Op::JumpSame: DOTEK_JUMP(same(cells[at->a], cells[at->b]));
    case Op::JumpDifferent: DOTEK_JUMP(!same(cells[at->a], cells[at->b]));
    case Op::JumpTrue: DOTEK_JUMP(cells[at->a] != 0);
    case Op::JumpFalse: DOTEK_JUMP(cells[at->a] == 0);
    case Op::Jump: DOTEK_JUMP(true);
    case Op::JumpSignal: {
      leave();
      const std::optional<bool> there = machine_.signalIsThere();
      if (!there) return refuse(code_.texts[at->b]);
      DOTEK_JUMP(*there);
    }
    case Op::JumpMissed:
      leave();
      if (machine_.lastSkip() == Machine::Skip::Pressed) return refuse(code_.texts[at->b]);
      DOTEK_JUMP(machine_.lastSkip() == Machine::Skip::Missed);
    case Op::SkipDelete: DOTEK_JUMP((machine_.blockDelete() >> at->detail & 1) != 0);
#undef DOTEK_JUMP
    case Op::Test:
      cells[at->c] = (at->detail == kIsNull
                          ? isNull(cells[at->a])
                          : test(static_cast<ir::Relation>(at->detail), cells[at->a], cells[at->b], tie))
                         ? 1
                         : 0;
      break;
    case Op::And: cells[at->c] = cells[at->a] != 0 && cells[at->b] != 0 ? 1 : 0; break;
    case Op::Or: cells[at->c] = cells[at->a] != 0 || cells[at->b] != 0 ? 1 : 0; break;
    case Op::Not: cells[at->c] = cells[at->a] == 0 ? 1 : 0; break;
    case Op::Sequence: machine_.sequence(at->a); break;
    // What follows may go on elsewhere: place_ is then the next instruction.
    case Op::JumpTo: leave(); return spend(1) && jumpTo(*levels_.back().routine, place_, cell(at->a));
    case Op::Block: leave(); return spend(10) && block(code_.blocks[at->a]);
    case Op::Call: leave(); return spend(10) && call(code_.calls[at->a]);
    case Op::Exit: leave(); return spend(10) && exit(at->a);
    case Op::Raise: leave(); return raise(number(at->a), code_.texts[at->b]);
    case Op::Notice:
      leave();
      machine_.message(isNull(cells[at->a]) || isUnknown(cells[at->a]) ? 0 : cells[at->a],
                       code_.texts[at->b]);
      if (listener_ != nullptr) listener_->message(code_.texts[at->b]);
      break;
    case Op::OpenPort:
      leave();
      if (!openPort(at->detail != 0)) return false;
      break;
    case Op::Print:
      leave();
      if (!spend(10) || !print(*code_.prints[at->a])) return false;
      fuel = fuel_;
      if (trail_ && !kWatched) {
        ++place_;
        return true;
      }
      break;
    case Op::Name: {
      const ir::NameVariables& names = *code_.names[at->a];
      if (Trace* const trace = machine_.trace(); trace != nullptr) {
        trace->begin("names").text(std::to_string(names.first));
        for (const std::string& name : names.names)
          trace->text(name);
        trace->end();
      }
      leave();
      if (listener_ != nullptr) listener_->named(names);
      break;
    }
    case Op::Refuse: leave(); return refuse(code_.texts[at->b]);
    case Op::Fault: leave(); return machine_.raiseUnnumbered(code_.texts[at->b]);
    case Op::Given:
      leave();
      if (isNull(cells[at->a])) return refuse(code_.texts[at->b]);
      break;
    case Op::Absolute:
      leave();
      if (machine_.mode(kDistance) != 0) return refuse(code_.texts[at->b]);
      break;
    case Op::Place: cells[at->c] = machine_.position()[at->detail]; break;
    case Op::CallPlace: leave(); return spend(10) && callPlace(at->c);
    case Op::LeavePlace: leave(); return spend(10) && leavePlace(code_.texts[at->b]);
    case Op::Pause:
    case Op::Record:
      leave();
      if (at->op == Op::Pause)
        machine_.pause(code_.texts[at->b]);
      else
        machine_.record(code_.texts[at->b], at->a == kNoCell ? std::nullopt : std::optional(cells[at->a]));
      if (!machine_.running() || !spend(10)) return false; // who watches has ended it
      fuel = fuel_;
      if (trail_ && !kWatched) {
        ++place_;
        return true;
      }
      break;
    case Op::CountBlock: machine_.countBlock(code_.lines[static_cast<std::size_t>(at - all)]); break;
    case Op::Act:
      leave();
      machine_.atLine(code_.lines[place_]);
      if (!code_.actions[at->a](machine_, cells) || !machine_.running() || !spend(10)) return false;
      fuel = fuel_;
      if (trail_ && !kWatched) {
        ++place_;
        return true;
      }
      break;
    case Op::Round:
      leave();
      if (!round()) return false;
      break;
    case Op::End: leave(); return textEnd();
    }
    ++at;
  }
}

SourceRange Run::place() const {
  if (place_ >= code_.instructions.size()) return {};
  if (loop_) return loop_->head->origin.range();
  const ir::Program& program = *code_.routineOf(place_).program;
  if (program.body.empty()) return program.range;
  const ir::ProgramStatement& statement = code_.statementOf(place_);
  const RunEnd& end = machine_.end();
  if (const auto* block = std::get_if<ir::NcBlock>(&statement.node); block != nullptr && end.letter != 0) {
    std::uint32_t seen = 0;
    for (const ir::Word& word : block->words)
      if (word.address == end.letter && seen++ == end.which && word.range.hasPlace()) return word.range;
  }
  return statement.origin.range();
}

std::vector<SourceRange> Run::openCalls() const {
  std::vector<SourceRange> out;
  for (std::size_t i = 1; i < levels_.size(); ++i)
    out.push_back(code_.statementOf(levels_[i].caller).origin.range());
  return out;
}

} // namespace dotek::sim
