// Blocks of words: what is handed to the machine, and codes that call programs.
#include "ir/Match.h"
#include "sim/machine/Axes.h"
#include "sim/machine/Run.h"
#include "sim/machine/Value.h"
#include "stdlib/ReadAhead.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

using ir::NcWords;

namespace {

// Numbers of things: rounded, as a control does; G is exact.
bool counts(char letter) {
  return letter != 'G' && ir::isAddressIn(ir::kWholeAddresses, letter);
}

} // namespace

// ROUND after an address. What it rounds to after F and E no source says.
bool Run::toIncrement(char letter, double& value) {
  if (control_.isLength(letter)) {
    value = machine_.toIncrement(value);
    return true;
  }
  if (counts(letter)) {
    value = std::round(value) + 0.0;
    return true;
  }
  return machine_.inconclusive("what ROUND rounds to after this address is not known", letter);
}

void Run::addCode(char letter, double value, bool exact) {
  constexpr double kMost = 99999;
  if (letter == 'M') {
    const double whole = exact ? value : std::round(value);
    words_.addM(whole >= 0 && whole <= 99'999'999 && whole == std::floor(whole)
                    ? static_cast<std::uint32_t>(whole)
                    : NcWords::kNoCode);
    return;
  }
  const double tenths = std::round(value * 10);
  const bool good = value >= 0 && value <= kMost && std::abs(value * 10 - tenths) < 1e-6;
  words_.addG(good ? static_cast<std::uint32_t>(tenths) : NcWords::kNoCode);
}

// The words of the block but the one at `without`.
bool Run::fill(const BlockSlots& slots, std::uint32_t without) {
  NcWords& w = words_;
  w.clear();
  w.line = slots.line;
  for (std::uint32_t i = 0; i < slots.words; ++i) {
    if (i == without) continue;
    const WordSlot& slot = code_.words[slots.firstWord + i];
    double value = cells_[slot.cell];
    if (isNull(value)) continue;
    if (slot.letter < 'A' || slot.letter > 'Z') return machine_.inconclusive("an address that is no letter");
    const auto index = static_cast<std::size_t>(slot.letter - 'A');
    if (slot.letter == 'G' || slot.letter == 'M') {
      addCode(slot.letter, value, !slot.computed);
      w.value[index] = value;
      if (!slot.computed && slot.point && slot.letter == 'M') w.m[w.mCount - 1] = NcWords::kNoCode;
      continue;
    }
    const std::uint32_t bit = ir::addressBit(slot.letter);
    w.repeated |= w.present & bit;
    w.present |= bit;
    if (slot.computed) {
      w.pointed |= bit;
      // Rounded here, so that the block may take the short way.
      if (counts(slot.letter))
        value = std::round(value) + 0.0;
      else if (control_.isLength(slot.letter))
        value = machine_.toIncrement(value);
      else
        w.mostPlaces = 99;
      if (machine_.mode(kUnits) != 0) w.mostPlaces = 99;
    } else {
      if (slot.point) w.pointed |= bit;
      w.mostPlaces = std::max<std::uint32_t>(w.mostPlaces, slot.places);
    }
    w.value[index] = value;
  }
  return true;
}

bool Run::block(const BlockSlots& slots) {
  for (std::uint32_t i = 0; machine_.hasUnknown() && i < slots.words; ++i)
    if (!knows(code_.words[slots.firstWord + i].cell)) return false;
  for (std::uint32_t i = 0; !unset_.empty() && i < slots.words; ++i)
    noteUnsetCell(code_.words[slots.firstWord + i].cell);
  for (std::uint32_t i = 0; !measured_.empty() && i < slots.words; ++i)
    tellMeasured(code_.words[slots.firstWord + i].cell);
  const Level& level = levels_.back();
  if (slots.mayCall && !level.byCode) {
    const stdlib::CallCode* found = nullptr;
    std::uint32_t at = 0;
    for (std::uint32_t i = 0; i < slots.words; ++i) {
      const WordSlot& slot = code_.words[slots.firstWord + i];
      const double value = cells_[slot.cell];
      if ((slot.letter != 'G' && slot.letter != 'M' && slot.letter != 'T') || isNull(value)) continue;
      const stdlib::CallCode* one = findCallCode(control_, slot.letter, value);
      if (one == nullptr) continue;
      if (found != nullptr) return refuse("two codes of one block call programs");
      found = one;
      at = i;
    }
    if (found != nullptr) return callByCode(slots, at, *found);
  }
  if (level.modalCalls > 0 && modal_[level.modalCalls - 1].eachBlock)
    return callOnBlock(slots, modal_[level.modalCalls - 1]);
  if (!fill(slots, slots.words)) return false;
  if (machine_.isLathe() && machine_.finishesContour(words_)) return beginContour(slots);
  if (!executeWords(slots)) return false;
  if (words_.present == 0 || !machine_.moved() || level.modalCalls == 0) {
    ++place_;
    return !contour_ || place_ != contour_->end || endContour();
  }
  const ModalCall& modal = modal_[level.modalCalls - 1];
  locals_ = modal.arguments;
  Request request;
  request.program = modal.program;
  request.repeats = modal.repeats;
  request.byCode = level.byCode;
  request.modalCalls = level.modalCalls - 1;
  return begin(request);
}

bool Run::beginContour(const BlockSlots& slots) {
  const auto whole = [&](char letter) {
    const double value = words_.of(letter);
    return words_.has(letter) && value >= 1 && value < 1e8 && value == std::floor(value)
               ? static_cast<std::uint64_t>(value)
               : 0;
  };
  // The block of that number, if there is one alone; kNoCell else.
  const auto placeOf = [&](std::uint64_t number) {
    std::uint32_t place = kNoCell, found = 0;
    for (const NumberedPlace& label : levels_.back().routine->labels)
      if (label.number == number && ++found != 0) place = label.place;
    return found == 1 ? place : kNoCell;
  };
  const std::uint64_t first = whole('P'), last = whole('Q');
  if (first == 0 || last == 0 || contour_)
    return refuse("`G70` takes P and Q, the N numbers of the first and the last block of a contour, and is "
                  "outside of it");
  const std::uint32_t begin = placeOf(first);
  std::uint32_t end = placeOf(last);
  for (const auto& [place, number] : {std::pair(begin, first), std::pair(end, last)})
    if (place == kNoCell) return refuse(fmt::format("the program has no block N{}, or several", number));
  const auto isPlain = [&](std::uint32_t at) {
    const Instruction& instruction = code_.instructions[at];
    if (instruction.op == Op::Block && code_.blocks[instruction.a].mayCall) return false;
    return ir::match(
        code_.statementOf(at),
        [](const ir::OneOf<ir::NcBlock, ir::Label, ir::Comment> auto&) { return true; },
        [](const ir::OneOf<ir::Jump, ir::Branch, ir::Store, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Call,
                           ir::Exit, ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {
          return false;
        });
  };
  const std::uint32_t text = levels_.back().routine->end;
  bool plain = begin <= end;
  for (std::uint32_t at = begin; plain && at < end; ++at)
    plain = isPlain(at);
  // What computes its words is before the block.
  while (plain && end < text && code_.instructions[end].op != Op::Block)
    plain = isPlain(end++);
  plain = plain && end < text && isPlain(end) && levels_.back().modalCalls == 0;
  if (!plain) return refuse("a contour of `G70` is blocks alone, from its first to its last");
  if (machine_.uncertain() != 0) return refuse("where the cycle begins is not known");
  // What else the block says comes first.
  words_.present &= ~ir::addressBits("PQ");
  const auto other =
      std::remove_if(words_.g.begin(), words_.g.begin() + words_.gCount, [&](std::uint32_t code) {
        NcWords one;
        one.addG(code);
        return machine_.finishesContour(one);
      });
  words_.gCount = static_cast<std::uint32_t>(other - words_.g.begin());
  if (words_.gCount == 0) words_.present &= ~ir::addressBit('G');
  if (!executeWords(slots)) return false;
  contour_ = Contour{end + 1, place_ + 1, machine_.position()};
  place_ = begin;
  return true;
}

// Which code of group 1 is in force then is in no source.
bool Run::endContour() {
  const Position start = contour_->start;
  const std::uint32_t next = contour_->back;
  contour_.reset();
  place_ = next - 1;
  if (!machine_.rapidTo(start)) return false;
  machine_.forgetMotion(machine_.feed());
  if (listener_ == nullptr) {
    place_ = next;
    return true;
  }
  // Who writes the blocks down has none for this move.
  const double unit = machine_.mode(kUnits) != 0 ? kInch : 1;
  NcWords back;
  back.addG(0);
  back.set('X', start[0] * (machine_.countsDiameters() ? 2 : 1) / unit);
  back.set('Z', start[2] / unit);
  listener_->blockDone(back, ir::addressBits("XZ"));
  place_ = next;
  return true;
}

bool Run::executeWords(const BlockSlots& slots) {
  if (words_.present == 0) return true;
  machine_.expectNoContact(slots.positions);
  const bool goesOn = machine_.execute(words_);
  if (listener_ != nullptr && (goesOn || machine_.end().ending == Ending::ProgramEnd)) tellBlock(slots);
  if (!goesOn) {
    const Ending ending = machine_.end().ending;
    if (ending == Ending::Call || ending == Ending::Return)
      return machine_.inconclusive("a call or a return by a computed code");
    return false;
  }
  checkShift();
  if (machine_.moved() && !limited_) {
    ahead_ = true;
    for (std::uint32_t i = 0; i < words_.gCount; ++i)
      skipAhead_ = skipAhead_ || words_.g[i] == 310;
  }
  if (slots.mayStop) noteStops();
  return true;
}

void Run::expectMotion() {
  expectsMotion_ = true;
  expectAhead();
}

// What moved last is not known; a skip move of a control that waits at G31 is done.
void Run::expectAhead() {
  ahead_ = expectsMotion_ && !limited_;
  skipAhead_ = ahead_ && !stdlib::stopsReadingAhead(control_, 'G', 31);
}

void Run::noteRead(std::uint32_t number) {
  if (readEarly_[place_] || !machine_.changesWithMotion(number)) return;
  if (!skipAhead_ && machine_.isSkipPosition(number)) return; // latched by the signal
  readEarly_[place_] = true;
  early_.push_back({code_.statementOf(place_).origin.range(), number});
}

// A block that waits for the motion before it, or says how far the control reads on.
void Run::noteStops() {
  bool stops = false;
  for (std::uint32_t i = 0; i < words_.gCount; ++i) {
    stops = stops || stdlib::stopsReadingAhead(control_, 'G', words_.g[i] / 10.0);
    if (words_.g[i] != 1030) continue;
    limited_ =
        stdlib::readAheadLimit(control_, words_.has('P') ? std::optional(words_.of('P')) : std::nullopt)
            .value_or(limited_);
    stops = stops || limited_;
  }
  for (std::uint32_t i = 0; i < words_.mCount; ++i)
    stops = stops || stdlib::stopsReadingAhead(control_, 'M', words_.m[i]);
  if (stops) ahead_ = skipAhead_ = false;
}

void Run::tellBlock(const BlockSlots& slots) {
  std::uint32_t points = 0;
  for (std::uint32_t i = 0; i < slots.words; ++i) {
    const WordSlot& slot = code_.words[slots.firstWord + i];
    if (!slot.computed && slot.point) points |= ir::addressBit(slot.letter);
  }
  listener_->blockDone(words_, points);
}

// G and M codes of macros: the words after the code are its arguments. Codes of subprograms, and T: the rest
// of the block comes first.
bool Run::callByCode(const BlockSlots& slots, std::uint32_t at, const stdlib::CallCode& code) {
  const WordSlot& caller = code_.words[slots.firstWord + at];
  const double number = std::round(cells_[caller.cell]);
  Request request;
  request.program =
      code.letter == 'T' ? code.program : code.program + static_cast<std::uint32_t>(number) - code.first;
  request.macro = code.macro;
  request.byCode = true;
  request.modalCalls = levels_.back().modalCalls;
  std::fill(locals_.begin(), locals_.end(), kNull);
  if (code.macro) {
    ArgumentLetters letters;
    for (std::uint32_t i = 0; i < slots.words; ++i) {
      const WordSlot& slot = code_.words[slots.firstWord + i];
      const double value = cells_[slot.cell];
      if (i == at) continue;
      if (i < at) return machine_.inconclusive("a word before the code that calls a program", slot.letter);
      if (isNull(value)) continue;
      if (slot.letter == 'L') {
        if (!repeatsOf(value, request.repeats)) return false;
        continue;
      }
      const std::uint32_t local = letters.next(slot.letter);
      if (local == 0) return machine_.inconclusive("it is no argument of a call by a code", slot.letter);
      const bool bare = !slot.computed && !slot.point && control_.countsIncrements(slot.letter);
      if (bare && machine_.mode(kUnits) != 0)
        return machine_.inconclusive("what it counts without a point is not known", slot.letter);
      if (local < locals_.size()) locals_[local] = bare ? value * control_.increment : value;
    }
  } else {
    if (!fill(slots, at)) return false;
    if (words_.mCount != 0)
      return machine_.inconclusive("whether the call or the M code comes first is not known", 'M');
    if (!executeWords(slots)) return false;
    if (machine_.moved() && words_.present != 0 && levels_.back().modalCalls > 0)
      return refuse("a motion and a call by a code in one block while G66 is in force");
  }
  if (code.holds && !machine_.write(*code.holds, number)) return false;
  return begin(request);
}

// G66.1: the words of the block are the arguments, and nothing else of it is carried out.
bool Run::callOnBlock(const BlockSlots& slots, const ModalCall& modal) {
  Request request;
  request.program = modal.program;
  request.repeats = modal.repeats;
  request.byCode = levels_.back().byCode;
  request.modalCalls = levels_.back().modalCalls - 1;
  std::fill(locals_.begin(), locals_.end(), kNull);
  ArgumentLetters letters;
  for (std::uint32_t i = 0; i < slots.words; ++i) {
    const WordSlot& slot = code_.words[slots.firstWord + i];
    const double value = cells_[slot.cell];
    if (isNull(value)) continue;
    const std::uint32_t local = letters.next(slot.letter);
    if (local == 0)
      return machine_.inconclusive("which variable it sets under G66.1 is not known", slot.letter);
    const bool bare = !slot.computed && !slot.point && control_.countsIncrements(slot.letter);
    if (local < locals_.size()) locals_[local] = bare ? value * control_.increment : value;
  }
  return begin(request);
}

} // namespace dotek::sim
