// Calls, returns and jumps by number.
#include "ir/Walk.h"
#include "sim/machine/Compile.h"
#include "sim/machine/Refusals.h"
#include "sim/machine/Run.h"
#include "sim/machine/Value.h"
#include "stdlib/CalledProgram.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <span>

namespace dotek::sim {

using stdlib::Alarm;

namespace {
constexpr std::uint32_t kFourDigits = 9999; // of a block number
constexpr double kMostSequence = 1e9;
} // namespace

bool Run::repeatsOf(double value, std::uint32_t& repeats) {
  if (isNull(value)) return true; // the word is left out
  const double whole = std::round(value);
  if (!(whole >= 1 && whole <= 9999)) return machine_.inconclusive("a call repeats 1 to 9999 times", 'L');
  repeats = static_cast<std::uint32_t>(whole);
  return true;
}

bool Run::call(const CallSlots& slots) {
  if (slots.kind == ir::CallKind::Off) return modalOff();
  if (!knows(slots.program) || !knows(slots.repeats)) return false;
  tellMeasured(slots.program);
  tellMeasured(slots.repeats);
  const double program = slots.program == kNoCell ? kNull : cell(slots.program);
  if (slots.program == kNoCell && slots.kind == ir::CallKind::Subprogram && slots.arguments == 1)
    return callBlock(slots, *levels_.back().routine);
  if (isNull(program)) return machine_.raise(Alarm::NoProgramNumber);
  Request request;
  double number = std::round(program);
  if (slots.repeats != kNoCell && !repeatsOf(cell(slots.repeats), request.repeats)) return false;
  if (slots.kind == ir::CallKind::Subprogram && slots.repeats == kNoCell && number >= 1 &&
      number <= 99'999'999) {
    const auto [called, times] = stdlib::subprogramCall(static_cast<std::uint64_t>(number), control_);
    request.repeats = times;
    number = static_cast<double>(called);
  }
  if (!(number >= 1 && number <= control_.programLast))
    return machine_.inconclusive(
        fmt::format("its programs have numbers from 1 to {}; {}", control_.programLast, kLongProgramNumbers),
        'P');
  request.program = static_cast<std::uint64_t>(number);
  if (slots.kind == ir::CallKind::Subprogram && slots.arguments == 1) {
    const Routine* const routine = code_.find(request.program);
    return routine == nullptr ? begin(request) : callBlock(slots, *routine);
  }
  request.macro = slots.kind != ir::CallKind::Subprogram;
  request.byCode = levels_.back().byCode;
  request.modalCalls = levels_.back().modalCalls;
  std::fill(locals_.begin(), locals_.end(), kNull);
  for (std::uint32_t i = 0; i < slots.arguments; ++i) {
    const ArgumentSlot& argument = code_.arguments[slots.firstArgument + i];
    if (!knows(argument.cell)) return false;
    tellMeasured(argument.cell);
    const double value = cells_[argument.cell];
    if (isNull(value)) continue;
    // A length as written counts increments where the control does not calculate.
    if (argument.bare && machine_.mode(kUnits) != 0)
      return refuse("what an argument without a point counts in inches is not known");
    locals_[argument.local] = argument.bare ? value * control_.increment : value;
  }
  if (slots.kind == ir::CallKind::Macro || slots.kind == ir::CallKind::Subprogram) return begin(request);

  // G66, G66.1: in force from the next block on.
  if (levels_.back().modalCalls != modal_.size()) return refuse("G66 within a macro that G66 called");
  if (modal_.size() >= control_.macroLevels) return machine_.raise(Alarm::MacroDepth);
  modal_.push_back({request.program, request.repeats, slots.kind == ir::CallKind::EachBlock, locals_});
  for (Level& level : levels_)
    if (level.modalCalls + 1 == modal_.size()) ++level.modalCalls;
  machine_.noteModal(stdlib::Function::ModalCall);
  ++place_;
  return true;
}

// M98 Q, M97 P: from that block of the program to M99, with the caller's locals.
bool Run::callBlock(const CallSlots& slots, const Routine& routine) {
  const std::uint32_t cellOfBlock = code_.arguments[slots.firstArgument].cell;
  if (!knows(cellOfBlock)) return false;
  tellMeasured(cellOfBlock);
  Level level;
  level.caller = place_;
  level.routine = &routine;
  level.byCode = levels_.back().byCode;
  level.modalCalls = levels_.back().modalCalls;
  if (slots.repeats != kNoCell && !repeatsOf(cell(slots.repeats), level.repeats)) return false;
  const std::uint64_t number = sequenceNumber(nullAsZero(cells_[cellOfBlock]), control_);
  const std::uint32_t from = &routine == levels_.back().routine ? place_ : routine.begin;
  const NumberedPlace* const to = number == 0 ? nullptr : code_.search(routine, from, number);
  if (to == nullptr) return machine_.raise(Alarm::NoSuchSequence);
  if (code_.entersLoop(0, to->loop))
    return refuse("a call of a block within a loop: the control does not know how it was begun");
  level.entry = to->place;
  if (!beginPass(level)) return false;
  levels_.push_back(std::move(level));
  return true;
}

bool Run::modalOff() {
  if (levels_.back().modalCalls != modal_.size()) return refuse("G67 within a macro that G66 called");
  if (!modal_.empty()) modal_.pop_back();
  for (Level& level : levels_)
    level.modalCalls = std::min<std::uint32_t>(level.modalCalls, static_cast<std::uint32_t>(modal_.size()));
  if (modal_.empty()) machine_.noteModal(stdlib::Function::ModalCallOff);
  ++place_;
  return true;
}

// The place of the caller is place_; the arguments lie in locals_.
bool Run::begin(const Request& request) {
  Level level;
  level.caller = place_;
  level.repeats = request.repeats;
  level.macro = request.macro;
  level.byCode = request.byCode;
  level.modalCalls = request.modalCalls;
  level.routine = code_.find(request.program);
  if (level.routine != nullptr) {
    if (request.macro && request.repeats > 1) level.arguments = locals_;
    if (!beginPass(level)) return false;
    levels_.push_back(std::move(level));
    return true;
  }
  if (const auto file = unreadable_.find(request.program); file != unreadable_.end())
    return refuse(
        fmt::format("it calls O{:04}, which is in `{}` and has errors, so what it does is not known; "
                    "`dotek lint` shows them",
                    request.program, file->second));
  const auto number = static_cast<std::uint32_t>(request.program);
  if (!request.macro && passesOverAbsent_) {
    if (!spend(1)) return false;
    if (MotionWatcher* const watcher = machine_.watcher(); watcher != nullptr) watcher->absentCalled(number);
    ++place_;
    return true;
  }
  if (meaning_ == nullptr || !request.macro || !meaning_->knows(number))
    return machine_.raise(Alarm::NoSuchProgram);
  const auto ofMisses = valuesOfMisses();
  for (std::uint32_t i = 0; i < request.repeats; ++i) {
    if (!spend(10) || !machine_.enter({number, 0, 0, true})) return false;
    std::copy(locals_.begin() + 1, locals_.end(), cells_ + 1);
    if (MotionWatcher* const watcher = machine_.watcher(); watcher != nullptr)
      watcher->callBegins(number, locals_);
    if (!meaning_->run(machine_, number, std::span<const double>(cells_, locals_.size()))) return false;
    machine_.leave();
    if (MotionWatcher* const watcher = machine_.watcher(); watcher != nullptr) watcher->callEnded(number);
    if (listener_ != nullptr) listener_->meaningRan(number, locals_);
    takeMeasured();
  }
  forgetChanged(ofMisses);
  expectAhead();
  ++place_;
  return true;
}

// Each pass of a macro begins with the arguments of the call.
bool Run::beginPass(const Level& level) {
  Frame frame;
  frame.program = static_cast<std::uint32_t>(level.routine->number);
  frame.macro = level.macro;
  if (!machine_.enter(frame)) return false;
  if (level.macro) {
    std::copy(locals_.begin() + 1, locals_.end(), cells_ + 1);
    enterMisses();
    if (MotionWatcher* const watcher = machine_.watcher(); watcher != nullptr)
      watcher->callBegins(frame.program, locals_);
  }
  place_ = level.entry == kNoCell ? level.routine->begin : level.entry;
  return true;
}

bool Run::exit(std::uint32_t at) {
  const double block = at == kNoCell ? kNull : cell(at);
  if (levels_.size() == 1) {
    if (!isNull(block)) return jumpTo(*levels_.back().routine, place_, block);
    if (!beginAnew()) return false;
    place_ = levels_.back().routine->begin;
    return true;
  }
  Level& level = levels_.back();
  if (!isNull(block) && level.repeats > 1)
    return refuse("M99 with P within a call that repeats: whether it ends the repeats is not known");
  if (level.repeats > 1) {
    --level.repeats;
    leaveLevel(level);
    if (level.macro) locals_ = level.arguments;
    return beginPass(level);
  }
  const std::uint32_t caller = level.caller;
  if (isNull(block)) {
    leaveLevel(level);
    levels_.pop_back();
    place_ = caller + 1;
    return true;
  }
  // Where there is no such block the alarm comes here, in the program that asks for it.
  const Routine& routine = *levels_[levels_.size() - 2].routine;
  const std::uint32_t here = place_;
  if (!jumpTo(routine, caller, block)) {
    place_ = here;
    return false;
  }
  leaveLevel(level);
  levels_.pop_back();
  return true;
}

namespace {

// M2 or M30 is written, or a code that is computed may be one.
bool mayEnd(const Routine& routine) {
  for (const ir::ProgramStatement& statement : routine.program->body) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    for (const ir::Word& word : block->words) {
      if (word.address != 'M') continue;
      const double* code = ir::constantValue(word.value);
      if (code == nullptr || *code == 2 || *code == 30) return true;
    }
  }
  return false;
}

} // namespace

bool Run::beginAnew() {
  constexpr std::uint64_t kMostPasses = 1000; // of programs that hold no end, and of those that are compared
  if (++passes_ > kMostPasses) return true;
  std::vector<double> now = machine_.snapshot();
  // Bit patterns: null is one.
  if (now.size() == lastPass_.size() &&
      std::memcmp(now.data(), lastPass_.data(), now.size() * sizeof(double)) == 0)
    return machine_.overLimit(
        "M99 at the end of a main program begins it anew, and the last pass has changed "
        "nothing: it would run for ever");
  lastPass_ = std::move(now);
  if (passes_ < kMostPasses || std::any_of(code_.routines.begin(), code_.routines.end(), mayEnd)) return true;
  return machine_.overLimit(
      fmt::format("M99 at the end of a main program begins it anew, {} times by now, and "
                  "nothing in it ends the program",
                  passes_));
}

void Run::leaveLevel(const Level& level) {
  machine_.leave();
  if (level.macro) leaveMisses();
  if (MotionWatcher* const watcher = machine_.watcher(); watcher != nullptr && level.macro)
    watcher->callEnded(static_cast<std::uint32_t>(level.routine->number));
}

bool Run::textEnd() {
  if (levels_.size() == 1) return machine_.finish();
  return refuse("the program ends without M99; what the control does then is not known");
}

bool Run::jumpTo(const Routine& routine, std::uint32_t from, double value) {
  const std::uint64_t number = sequenceNumber(nullAsZero(value), control_);
  const NumberedPlace* const to = number == 0 ? nullptr : code_.search(routine, from, number);
  if (to == nullptr) {
    const double whole = std::round(nullAsZero(value));
    // That a control searches four digits is documented; where a profile has more, what is above them is not.
    if (control_.sequenceLast > kFourDigits && whole > control_.sequenceLast && whole < kMostSequence &&
        code_.search(routine, from, static_cast<std::uint64_t>(whole)) != nullptr)
      return refuse(fmt::format("whether the control searches block numbers above {} is not known; "
                                "`[programs] last_sequence` says so in a file that extends it "
                                "(`dotek new control`)",
                                control_.sequenceLast));
    return machine_.raise(Alarm::NoSuchSequence);
  }
  if (code_.entersLoop(code_.loops[from], to->loop))
    return refuse("a jump into a loop from outside: the control does not know how it was begun");
  place_ = to->place;
  return true;
}

bool Run::raise(double number, const std::string& text) {
  const double whole = std::round(number);
  if (!(whole >= control_.alarmFirst && whole <= control_.alarmLast))
    return refuse(fmt::format("the alarm {} lies outside of {} to {}; what the control shows is not known",
                              whole, control_.alarmFirst, control_.alarmLast));
  return machine_.raise(static_cast<std::uint32_t>(whole), text);
}

} // namespace dotek::sim
