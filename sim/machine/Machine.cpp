#include "sim/machine/Machine.h"

#include "sim/machine/Axes.h"
#include "sim/machine/MachineOffset.h"
#include "sim/machine/Refusals.h"
#include "stdlib/AlarmMeaning.h"
#include "stdlib/CodeTitles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

using ir::NcWords;
using stdlib::Alarm;
using stdlib::Function;

namespace {

constexpr std::uint32_t kMoveWords = kAxisBits | ir::addressBits("GNF");
constexpr std::uint32_t kArcWords = kMoveWords | ir::addressBits("IJK");
constexpr std::uint32_t kQuickWords[kMotions] = {kMoveWords, kMoveWords, kArcWords, kArcWords};

} // namespace

Machine::Machine(const stdlib::Control& control, Dialect dialect)
    : control_(&control), turning_(control.turning ? &*control.turning : nullptr),
      dialect_(std::move(dialect)), table_(control), layout_(control) {
  // What is in force at power on, as most machines are set: rapid, XY, absolute, mm, per minute, G54.
  for (const Function function :
       {Function::Rapid, Function::PlaneXY, Function::Absolute, Function::Metric, Function::FeedPerMinute,
        Function::CutterCompOff, Function::ToolLengthOff, Function::CannedCycleOff, Function::ReturnInitial,
        Function::ScalingOff, Function::ModalCallOff, Function::SurfaceSpeedOff, Function::WorkSystem,
        Function::RotationOff, Function::PolarOff, Function::MirrorOff}) {
    if (const Code* code = table_.find(function); code != nullptr && code->group != 0)
      groups_[code->group] = code->tenths;
  }
  if (const Code* code = &table_.g(540); code->group != 0) groups_[code->group] = 540;
  if (const Code* code = &table_.g(640); code->group != 0) groups_[code->group] = 640;
  const auto start = [&](const std::vector<std::uint32_t>& codes) {
    for (const std::uint32_t tenths : codes) {
      const Code& code = table_.g(tenths);
      modes_[code.slot] = code.value;
      groups_[code.group] = code.tenths;
    }
  };
  start(dialect_.startCodes);
  if (turning_ != nullptr) {
    start(turning_->startCodes);
    long_ = 1;
  }
  if (turning_ != nullptr || dialect_.isLathe) shown_ = 1u << 0 | 1u << 2;
  needPoint_ = control.decimal == stdlib::DecimalMode::Increment ? control.lengths : 0;
  mostPlaces_ = static_cast<std::uint32_t>(control.decimals);
  widest_ = std::pow(10.0, control.integerDigits);
  if (control.arcTolerance) arcTolerance_ = *control.arcTolerance;
  extended_.resize(static_cast<std::size_t>(control.variables.extendedCount) + 1);
  tools_.resize(static_cast<std::size_t>(control.variables.toolCount) + 1);
  cells_.assign(layout_.size(), kFresh);
  cells_[0] = kNull;
  for (const stdlib::StateRange& range : control.state)
    state_.insert(state_.end(), range.last - range.first + 1,
                  range.null ? kNull : range.initial.value_or(kFresh));
  if (control.window) pmc_.assign(control.window->bytes, 0);
  roundsCorners_ = stdlib::roundsCorners(control);
  stack_.reserve(64);
  stack_.emplace_back();
}

void Machine::setTrace(Trace* trace) {
  trace_ = trace;
  if (trace != nullptr && (turning_ != nullptr || dialect_.isLathe)) trace->showLathe(showsDiameters());
}

void Machine::setWatcher(MotionWatcher* watcher) {
  watcher_ = watcher;
  if (watcher == nullptr) return;
  long_ = 1;
  at_ = machinePosition();
  lost_ = uncertain_;
}

void Machine::startAt(const Position& machine) {
  stopAt(machine);
  at_ = machine;
}

void Machine::stopAt(const Position& machine) {
  for (std::size_t i = 0; i < kAxes; ++i)
    work_[i] = snap(machine[i] - offset_[i] - (i == 2 ? toolLength_ : 0));
}

Position Machine::machinePosition() const {
  Position out;
  for (std::size_t i = 0; i < kAxes; ++i)
    out[i] = snap(work_[i] + offset_[i] + (i == 2 ? toolLength_ : 0));
  return out;
}

Position Machine::zeroOf(std::uint32_t system) const {
  Position out;
  for (std::size_t i = 0; i < kAxes; ++i)
    out[i] = snap(external_[i] + systems_[system][i]);
  return out;
}

void Machine::setZero(std::uint32_t system, const Position& zero) {
  for (std::size_t i = 0; i < kAxes; ++i)
    systems_[system][i] = zero[i] - external_[i];
  updateOffsets();
}

void Machine::setToolLength(std::uint32_t tool, double length) {
  if (tool >= tools_.size()) tools_.resize(tool + 1);
  tools_[tool] = control_->variables.toolGeometry ? ToolOffset{0, length} : ToolOffset{length, 0};
}

double Machine::toolLengthOf(std::uint32_t tool) const {
  return tool < tools_.size() ? snap(tools_[tool].wear + tools_[tool].geometry) : 0;
}

void Machine::putTool(std::uint32_t tool) {
  toolNumber_ = tool;
  modalWords_[slotOf('T')] = tool;
}

// The short way: nothing but straight moves and arcs in mm, and the codes that go with them. Whatever else a
// block holds, or what is out of range, takes the long way from the beginning: nothing is changed before
// that is known.
bool Machine::execute(const NcWords& w) {
  std::uint32_t odd = long_ | w.marks | w.repeated | (w.present & ~w.pointed & needPoint_);
  std::array<std::uint8_t, kSlots> modes = modes_;
  for (std::uint32_t i = 0; i < w.gCount; ++i) {
    const Code& code = table_.g(w.g[i]);
    modes[code.slot] = code.value;
    odd |= code.flags;
  }
  const std::uint8_t motion = modes[kMotion];
  odd |= w.present & ~kQuickWords[motion];
  odd |= w.mostPlaces > mostPlaces_ ? 1 : 0;
  if (odd != 0) return executeLong(w);

  const double feed = (w.present & ir::addressBit('F')) != 0 ? w.of('F') : feed_;
  const std::uint32_t axes = w.present & kAxisBits;
  const bool incremental = modes[kDistance] != 0;
  Position end = work_;
  for (unsigned i = 0; i < 3; ++i) {
    const double value = w.value[slotOf(kAxisLetters[i])];
    end[i] = has(w, i) ? value : end[i];
  }
  if (incremental) [[unlikely]] {
    for (unsigned i = 0; i < 3; ++i)
      end[i] = has(w, i) ? snap(work_[i] + end[i]) : work_[i];
  }
  double widest = std::max(std::abs(end[0]), std::max(std::abs(end[1]), std::abs(end[2])));
  if ((axes & ~ir::addressBits("XYZ")) != 0) [[unlikely]] {
    for (unsigned i = 3; i < kAxes; ++i) {
      if (!has(w, i)) continue;
      end[i] = snap((incremental ? work_[i] : 0) + w.value[slotOf(kAxisLetters[i])]);
      widest = std::max(widest, std::abs(end[i]));
    }
  }
  const bool arc = isArc(motion);
  if (!(widest < widest_) || !(feed > 0 || (feed == 0 && motion == kRapid)) ||
      (arc && !plainArc(w, kPlanes[modes[kPlane]], end)))
    return executeLong(w);
  ++blocks_;
  modes_ = modes;
  for (std::uint32_t i = 0; i < w.gCount; ++i) {
    const Code& code = table_.g(w.g[i]);
    groups_[code.group] = code.tenths;
  }
  feed_ = feed;
  if ((w.present & ir::addressBit('N')) != 0) modalWords_[slotOf('N')] = w.of('N');
  work_ = end;
  moved_ = axes != 0;
  shown_ |= axisNumbers(axes);
  if (trace_ != nullptr && axes != 0) [[unlikely]] {
    trace_->at(w.line);
    traceMove(motion == kRapid ? "rapid" : "feed", end, motion != kRapid);
  }
  return true;
}

// An arc whose ends have the same radius, as far as a bound without square roots can tell. Nobody looks at
// it.
bool Machine::plainArc(const NcWords& w, const PlaneAxes& plane, const Position& end) const {
  if (trace_ != nullptr) return false;
  if ((w.present & kAxisBits) == 0 && (w.present & ir::addressBits("IJK")) == 0) return true;
  if ((w.present & ir::addressBit(plane.unusedCentre)) != 0) return false;
  const double i = w.has(plane.firstCentre) ? w.of(plane.firstCentre) : 0;
  const double j = w.has(plane.secondCentre) ? w.of(plane.secondCentre) : 0;
  const double u = work_[plane.first] + i - end[plane.first];
  const double v = work_[plane.second] + j - end[plane.second];
  // |r - s| <= t follows from |r^2 - s^2| <= t * r, and r is at least the larger of i and j.
  return std::abs(u * u + v * v - i * i - j * j) <= arcTolerance_ * std::max(std::abs(i), std::abs(j));
}

bool Machine::executeLong(const NcWords& w) {
  if (!running()) return false;
  moved_ = false;
  stack_.back().line = w.line;
  if (w.has('N')) {
    modalWords_[slotOf('N')] = w.of('N');
    stack_.back().sequence = w.of('N') >= 0 && w.of('N') < 1e9 ? static_cast<std::uint32_t>(w.of('N')) : 0;
  }
  if (trace_ != nullptr) trace_->at(w.line);
  if ((w.marks & NcWords::ProgramMark) != 0) {
    return blocks_ == 0 || finish();
  }
  if ((w.marks & NcWords::ProgramName) != 0) {
    if (blocks_ != 0) return finish();
    if (w.has('O')) {
      if (!(w.of('O') >= 0 && w.of('O') <= control_->programLast))
        return inconclusive(
            fmt::format("its programs have numbers up to {}; {}", control_->programLast, kLongProgramNumbers),
            'O');
      modalWords_[slotOf('O')] = w.of('O');
      stack_.back().program = static_cast<std::uint32_t>(w.of('O'));
    }
    if ((w.present & ~ir::addressBit('O')) == 0) return true;
  }
  ++blocks_;
  if ((w.marks & NcWords::BlockDelete) != 0 && (deleteLevels_ >> w.deleteLevel & 1) != 0) return true;
  if ((w.marks & NcWords::TooManyCodes) != 0)
    return inconclusive(fmt::format("more than {} codes in one block", NcWords::kMostCodes));
  if (!readCodes(w)) return false;
  const NcWords& words = turning_ == nullptr ? w : turned(w);
  if (!running() || !checkWords(words) || !runBlock(words)) return false;
  const bool odd = turning_ != nullptr || (modes_[kCanned] | modes_[kUnits]) != 0 || uncertain_ != 0 ||
                   motionForgotten_ || feedForgotten_ || watcher_ != nullptr || rotation_.on() ||
                   afterRotation_ != 0 || offsetsPath();
  if (!running()) return false; // who watches has ended it
  long_ = odd ? 1 : 0;
  return true;
}

bool Machine::runBlock(const NcWords& w) {
  if (offsets_.active() && !OffsetWork(*this).before(w)) return false;
  if (!settings(w) || !miscellaneous(w)) return false;
  if (block_.endsRotation) rotationOff();
  if (!changeSystem(w) || !changeToolLength(w)) return false;
  if (block_.hasOneShot) {
    if (!oneShot(w)) return false;
  } else if (modes_[kCanned] != 0) {
    if (!cannedCycle(w)) return false;
  } else if (!move(w)) {
    return false;
  }
  if (offsets_.active()) OffsetWork(*this).after(w);
  return stops(w);
}

bool Machine::finish() {
  if (offsets_.active()) OffsetWork(*this).atEnd();
  return running() && stop(Ending::TextEnd);
}

// Puts the modal codes of the block in force and notes the others.
bool Machine::readCodes(const NcWords& w) {
  block_ = {};
  block_.before = modes_;
  for (std::uint32_t i = 0; i < w.gCount; ++i) {
    const Code& code = table_.g(w.g[i]);
    if ((code.flags & Code::Unknown) != 0)
      return inconclusive(w.g[i] == NcWords::kNoCode
                              ? std::string("it is no code of a control")
                              : unlistedText(control_->name, codeName('G', w.g[i]), false),
                          'G', i);
    switch (code.function) {
    case Function::Other: return inconclusive("what it does here is not known to Dotek", 'G', i);
    case Function::MirrorOn:
      return inconclusive("Dotek does not follow a mirror image; write the mirrored points for a run here",
                          'G', i);
    case Function::PolarOn:
      return inconclusive("Dotek does not follow polar coordinates, in which the words after it are a radius "
                          "and an angle; write the points in X, Y, Z for a run here",
                          'G', i);
    case Function::ScalingOn:
      return inconclusive("Dotek does not follow scaled coordinates; write the scaled points for a run here",
                          'G', i);
    case Function::SurfaceSpeedOn:
      if (turning_ != nullptr) break;
      return inconclusive("Dotek does not follow a spindle that turns with the position", 'G', i);
    default: break;
    }
    if ((code.flags & Code::OneShot) != 0) {
      if (block_.hasOneShot && block_.oneShot != code.function)
        return inconclusive("two functions of one block want its words", 'G', i);
      block_.hasOneShot = true;
      block_.oneShot = code.function;
      if (code.function == Function::MacroCall || code.function == Function::ModalCall) block_.call = 1;
    }
    if (code.function == Function::RotationOff) block_.endsRotation = true;
    // Of several codes of a group the last one holds.
    block_.slots |= 1u << code.slot;
    modes_[code.slot] = code.value;
    groups_[code.group] = code.tenths;
  }
  if (block_.endsRotation && block_.hasOneShot && block_.oneShot == Function::RotationOn)
    return inconclusive("a rotation begins and ends in one block", 'G');
  if (rotation_.on() && !block_.endsRotation && modes_[kPlane] != block_.before[kPlane])
    return refuseTurned("another plane");
  const bool motion = (block_.slots >> kMotion & 1) != 0;
  if (motion && (block_.slots >> kCanned & 1) != 0 && modes_[kCanned] != 0)
    return inconclusive("a canned cycle and a motion of group 1 in one block", 'G');
  if (motion) motionForgotten_ = false;
  // A motion code ends a canned cycle as G80 does.
  if (motion && modes_[kCanned] != 0) {
    modes_[kCanned] = 0;
    if (const Code* off = table_.find(Function::CannedCycleOff); off != nullptr)
      groups_[off->group] = off->tenths;
  }
  if (modes_[kCanned] == 0) {
    hasR_ = hasDepth_ = false;
    cyclePeck_ = cycleDwell_ = 0;
  }
  for (std::uint32_t i = 0; i < w.mCount; ++i) {
    const Code& code = table_.m(w.m[i] == NcWords::kNoCode ? 0x0FFFFFFF : w.m[i]);
    if (w.m[i] == NcWords::kNoCode) return inconclusive("it is no code of a control", 'M', i);
    if ((code.flags & Code::Unknown) != 0)
      return inconclusive(unlistedText(control_->name, fmt::format("M{}", w.m[i]), true), 'M', i);
    if (code.function == Function::Other)
      return inconclusive(w.m[i] == 97
                              ? "Dotek does not follow a local subprogram; for a run here write it as "
                                "a program of its own, with M99, and call it with M98 P"
                              : "what it does here is not known to Dotek",
                          'M', i);
    if (code.function == Function::SubprogramCall) block_.call = 1;
  }
  return block_.call == 0 || stop(Ending::Call);
}

// Every word is for something that the block does; one that is left over ends the run.
bool Machine::checkWords(const NcWords& w) {
  std::uint32_t allowed = kAxisBits | ir::addressBits("GMNOFSTDH");
  const bool axes = (w.present & kAxisBits) != 0;
  if (block_.hasOneShot) {
    switch (block_.oneShot) {
    case Function::Dwell:
      allowed |= ir::addressBits("P");
      if (dialect_.dwellLetter != 0) allowed |= ir::addressBit(dialect_.dwellLetter);
      break;
    case Function::DataInput: allowed |= ir::addressBits("LPR"); break;
    case Function::SecondReferenceReturn: allowed |= ir::addressBits("P"); break;
    case Function::RotationOn: allowed |= ir::addressBits("RIJK"); break;
    case Function::ContourFinish: allowed |= ir::addressBits("PQ"); break;
    case Function::ContourRough:
    case Function::PeckAlongZ:
    case Function::PeckAlongX:
    case Function::ThreadPasses: allowed |= ir::addressBits("ADIKPQR"); break;
    default: break;
    }
  } else if (modes_[kCanned] != 0) {
    allowed |= ir::addressBits("RQPIJ");
    if (control_->repeatLetter != 0) allowed |= ir::addressBit(control_->repeatLetter);
  } else if (isArc(modes_[kMotion])) {
    allowed |= ir::addressBits("IJKR");
  } else if (modes_[kMotion] >= kThread) {
    if (modes_[kMotion] != kThread) allowed |= ir::addressBits("R");
    if (modes_[kMotion] == kThread || modes_[kMotion] == kThreadingCycle) allowed |= ir::addressBits("Q");
  }
  if (modes_[kSystem] == kExtended && (block_.slots >> kSystem & 1) != 0) allowed |= ir::addressBit('P');
  // What an auxiliary code takes is its own; an axis word beside a G code could be its own, too.
  if (!block_.hasOneShot) {
    const auto auxiliary = [](const Code& code) { return code.function == Function::Auxiliary; };
    for (std::uint32_t i = 0; i < w.gCount; ++i)
      if (auxiliary(table_.g(w.g[i])) && axes)
        return inconclusive(
            "an auxiliary G code with axis words: whether they are its own is not known; write "
            "it in a block of its own",
            'G', i);
      else if (auxiliary(table_.g(w.g[i])))
        allowed |= ir::addressBits("EIJKLPQR");
    for (std::uint32_t i = 0; i < w.mCount; ++i)
      if (auxiliary(table_.m(w.m[i])) && !axes) allowed |= ir::addressBits("EIJKLPQR");
  }
  // Parameters of path modes are in a block without axes.
  if (!axes && !block_.hasOneShot) {
    for (std::uint32_t i = 0; i < w.gCount; ++i)
      if (table_.g(w.g[i]).function == Function::PathMode) allowed |= ir::addressBits("PQR");
  }
  const std::uint32_t left = w.present & ~allowed;
  if (left != 0)
    return inconclusive("nothing in the block takes it", static_cast<char>('A' + std::countr_zero(left)));
  if (w.repeated != 0)
    return inconclusive("the address appears twice", static_cast<char>('A' + std::countr_zero(w.repeated)),
                        1);
  return true;
}

bool Machine::stop(Ending ending) {
  end_.ending = ending;
  end_.line = stack_.back().line;
  long_ = 1;
  return false;
}

bool Machine::raise(Alarm alarm, char letter) {
  const stdlib::AlarmInfo* info = control_->find(alarm);
  if (info == nullptr && !dialect_.numbersAlarms)
    return inconclusive(fmt::format("what the control does then is not known ({})", stdlib::alarmName(alarm)),
                        letter);
  if (info == nullptr) {
    raiseUnnumbered(stdlib::alarmMeaning(alarm));
    end_.letter = letter;
    return false;
  }
  if (info->number == 0) return raiseUnnumbered(info->text);
  stop(Ending::Alarm);
  end_.number = info->number;
  end_.text = info->text;
  end_.letter = letter;
  end_.stack = stack_;
  if (trace_ != nullptr) trace_->begin("alarm").text(std::to_string(end_.number)).text(end_.text).end();
  return false;
}

bool Machine::raise(std::uint32_t n, std::string_view text) {
  stop(Ending::Alarm);
  end_.number = control_->alarmShown + n;
  end_.text = text;
  end_.letter = 0;
  end_.stack = stack_;
  if (trace_ != nullptr) trace_->begin("alarm").text(std::to_string(end_.number)).text(end_.text).end();
  return false;
}

void Machine::message(double number, std::string_view text) {
  if (watcher_ != nullptr) watcher_->messaged(number, text);
  if (trace_ != nullptr) trace_->begin("message").text(text).end();
}

bool Machine::inconclusive(std::string why, char letter, std::uint32_t which) {
  stop(Ending::Inconclusive);
  end_.text = std::move(why);
  end_.letter = letter;
  end_.which = which;
  end_.stack = stack_;
  return false;
}

bool Machine::meaningless(std::string why, char letter) {
  end_.ofValue = true;
  return inconclusive(std::move(why), letter);
}

bool Machine::overLimit(std::string what) {
  stop(Ending::Limit);
  end_.text = std::move(what);
  end_.letter = 0;
  end_.stack = stack_;
  return false;
}

void Machine::beginProgram(std::uint32_t number) {
  stack_.back().program = number;
  modalWords_[slotOf('O')] = number;
}

void Machine::noteModal(Function function) {
  if (const Code* code = table_.find(function); code != nullptr && code->group != 0)
    groups_[code->group] = code->tenths;
}

bool Machine::enter(const Frame& callee) {
  if (control_->callDepth && stack_.size() > *control_->callDepth) return raise(Alarm::SubprogramDepth);
  if (stack_.size() > callLimit_)
    return overLimit(
        fmt::format("calls nest deeper than {}; `--limit call-depth=N` allows more", callLimit_));
  if (callee.macro) {
    if (level_ >= control_->macroLevels) return raise(Alarm::MacroDepth);
    ++level_;
    const auto locals = cells_.begin() + 1;
    saved_.insert(saved_.end(), locals, locals + control_->locals);
    std::fill_n(locals, control_->locals, kNull);
  }
  stack_.push_back(callee);
  modalWords_[slotOf('O')] = callee.program;
  return true;
}

void Machine::leave() {
  if (stack_.size() < 2) return;
  if (stack_.back().macro) {
    --level_;
    const auto from = saved_.end() - static_cast<std::ptrdiff_t>(control_->locals);
    std::copy(from, saved_.end(), cells_.begin() + 1);
    saved_.erase(from, saved_.end());
  }
  stack_.pop_back();
  modalWords_[slotOf('O')] = stack_.back().program;
}

} // namespace dotek::sim
