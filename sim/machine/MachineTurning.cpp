// Blocks of a lathe in G code system A: increments by letters of their own, single cycles, pecks.
#include "sim/machine/Axes.h"
#include "sim/machine/Machine.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace dotek::sim {

using ir::NcWords;
using stdlib::Alarm;
using stdlib::Function;

namespace {

constexpr std::size_t kX = 0, kZ = 2;
constexpr std::uint32_t kPlaneAxes = 1u << kX | 1u << kZ;
constexpr double kMostPecks = 100'000;

// U, W, .. mean something else in the block, or the block is refused as a whole.
bool keepsWords(Function function) {
  switch (function) {
  case Function::Dwell:
  case Function::DataInput:
  case Function::MacroCall:
  case Function::ModalCall:
  case Function::ContourFinish:
  case Function::ContourRough:
  case Function::ThreadPasses: return true;
  default: return false;
  }
}

} // namespace

const NcWords& Machine::turned(const NcWords& w) {
  if (block_.hasOneShot && keepsWords(block_.oneShot)) return w;
  std::uint32_t letters = 0;
  for (const auto& [axis, increment] : turning_->increments)
    letters |= ir::addressBit(increment);
  if ((w.present & letters) == 0) return w;
  turnedWords_ = w;
  NcWords& out = turnedWords_;
  for (const auto& [axis, increment] : turning_->increments) {
    if (!w.has(increment)) continue;
    if (w.has(axis)) {
      inconclusive(fmt::format("{} and {} in one block: which of them counts is not known", axis, increment),
                   increment);
      return w;
    }
    const auto moved = [&, from = ir::addressBit(increment), to = ir::addressBit(axis)](std::uint32_t& bits) {
      if ((bits & from) != 0) bits = (bits & ~from) | to;
    };
    moved(out.present);
    moved(out.pointed);
    moved(out.repeated);
    out.value[slotOf(axis)] = w.of(increment);
    block_.increments |= 1u << std::string_view(kAxisLetters).find(axis);
  }
  return out;
}

// T0304: tool 3 with offset 4. All offsets are 0 here.
bool Machine::takesTool(std::uint32_t number) {
  std::uint32_t offsets = 1;
  for (std::uint32_t i = 0; i < turning_->offsetDigits; ++i)
    offsets *= 10;
  if (number != 0 && number < offsets)
    return inconclusive(
        fmt::format(
            "whether these digits name a tool or an offset depends on a parameter; with {} digits for "
            "each they are certain",
            turning_->offsetDigits),
        'T');
  if (number != 0) toolNumber_ = number / offsets;
  if (trace_ == nullptr) return true;
  if (number == 0)
    trace_->begin("tool-offset").text("off").end();
  else
    trace_->begin("tool").text(fmt::format("{} offset {}", toolNumber_, number % offsets)).end();
  return true;
}

bool Machine::leg(std::string_view action, MotionKind kind, const Position& end) {
  std::uint32_t axes = 0;
  for (std::size_t i = 0; i < kAxes; ++i)
    if (end[i] != work_[i]) axes |= 1u << i;
  work_ = end;
  moved_ = true;
  if (trace_ != nullptr) traceMove(action, end, kind != MotionKind::Rapid);
  if (watcher_ != nullptr) tellMotion(kind, axes);
  return running();
}

bool Machine::rapidTo(const Position& end) {
  return leg("rapid", MotionKind::Rapid, end);
}

// G90, G92, G94: in along one axis, the cut, out, and back to where it began. What pulls a thread out at its
// end (parameters 5130, 5131) is not followed.
bool Machine::singleCycle(const NcWords& w) {
  const bool begins = (block_.slots >> kMotion & 1) != 0;
  if (begins && block_.before[kMotion] < kTurningCycle) {
    cycleAxes_ = 0;
    cycleTaper_ = 0;
  }
  const std::uint32_t axes = axisNumbers(w.present & kAxisBits);
  if ((axes & ~kPlaneAxes) != 0) return inconclusive("a single cycle moves X and Z", 'G');
  if (axes == 0) {
    // `G90` among the codes of a first block: nothing moves, and nothing is there to repeat.
    if (begins || cycleAxes_ == 0) {
      if ((w.present & ir::addressBits("IKR")) == 0) return true;
      return inconclusive("a single cycle of a lathe without X and Z", 'G');
    }
    if ((w.present & ~ir::addressBit('N')) == 0) return true;
    return inconclusive(
        "a single cycle is in force (`G90`, `G92`, `G94`), and whether a block without X and Z "
        "repeats it is not certain; write `G0` before this block");
  }
  if ((uncertain_ & kPlaneAxes) != 0)
    return inconclusive("where the cycle begins is not known" + lostText(kPlaneAxes), 'G');
  if (!feedKnown()) return false;
  if (!(feed_ > 0)) return raise(Alarm::NoFeed);
  Position end;
  const Position start = work_;
  if (!target(w, end)) return false;
  for (const std::size_t axis : {kX, kZ}) {
    if ((axes >> axis & 1) != 0)
      cycleEnd_[axis] = end[axis];
    else if ((cycleAxes_ >> axis & 1) != 0)
      end[axis] = cycleEnd_[axis];
    else
      return inconclusive(
          fmt::format("a single cycle without {}, which no block before it gives", kAxisLetters[axis]), 'G');
  }
  cycleAxes_ |= axes;
  if (w.has('R')) cycleTaper_ = lengthOf(w, 'R');
  const bool facing = modes_[kMotion] == kFacingCycle, threads = modes_[kMotion] == kThreadingCycle;
  const std::size_t in = facing ? kZ : kX; // the axis of the first move and of the third
  Position at = start;
  at[in] = snap(end[in] + cycleTaper_);
  if (!leg("rapid", MotionKind::Rapid, at)) return false;
  at[kX] = end[kX];
  at[kZ] = end[kZ];
  if (!leg(threads ? "thread" : "feed", MotionKind::Feed, at)) return false;
  at[in] = start[in];
  if (!(threads ? leg("rapid", MotionKind::Rapid, at) : leg("feed", MotionKind::Feed, at))) return false;
  return leg("rapid", MotionKind::Rapid, start);
}

namespace {

// Of a message that begins with the code.
std::string placed(std::uint64_t line) {
  return line == 0 ? "the cycle" : fmt::format("the cycle of line {}", line);
}

} // namespace

// P and Q of pecks: least increments, without a point.
std::optional<double> Machine::pecked(const NcWords& w, char letter) {
  const double value = w.of(letter);
  if ((w.pointed & ir::addressBit(letter)) != 0 || modes_[kUnits] != 0 || !(value > 0) ||
      value != std::floor(value)) {
    inconclusive("a peck counts thousandths of a millimetre here, above 0 and without a point", letter);
    return std::nullopt;
  }
  return value * control_->increment;
}

// G74, G75: feed by a peck, back by the return, and so on to the depth; rapid out; and again a step further.
bool Machine::pecks(const NcWords& w, std::size_t along, std::size_t across) {
  const std::string name = placed(w.line);
  if ((w.present & ir::addressBits("ADIK")) != 0)
    return inconclusive(
        name + " in the form with one block, with I, K or D: this control takes the one with two, "
               "unless a parameter says otherwise",
        'G');
  std::optional<double>& back = peckReturn_[along];
  if ((w.present & kAxisBits) == 0) {
    if (!w.has('R') || (w.present & ir::addressBits("PQ")) != 0 || !(lengthOf(w, 'R') >= 0))
      return inconclusive(
          name + " without X and Z is the first of two blocks, and takes R, the return after a peck", 'G');
    back = lengthOf(w, 'R');
    return true;
  }
  const char size = along == kZ ? 'Q' : 'P', step = along == kZ ? 'P' : 'Q';
  if ((axisNumbers(w.present & kAxisBits) & ~kPlaneAxes) != 0 || !has(w, along) || !w.has(size))
    return inconclusive(fmt::format("{} is known with {}, and the peck {}", name, kAxisLetters[along], size),
                        'G');
  if (w.has('R') && w.of('R') != 0)
    return inconclusive(name + " with a relief at the bottom: which way it goes is not known", 'R');
  if (!back)
    return inconclusive(
        name + " without the first of its two blocks: a parameter says how far it goes back after a "
               "peck",
        'G');
  if ((uncertain_ & kPlaneAxes) != 0)
    return inconclusive("where the cycle begins is not known" + lostText(kPlaneAxes), 'G');
  if (!feedKnown()) return false;
  if (!(feed_ > 0)) return raise(Alarm::NoFeed);
  const std::optional<double> peck = pecked(w, size);
  if (!peck) return false;
  const Position start = work_;
  Position end;
  if (!target(w, end)) return false;
  const double depth = std::abs(end[along] - start[along]), way = end[along] < start[along] ? -1 : 1;
  std::vector<double> columns = {start[across]};
  if (end[across] != start[across]) {
    if (!w.has(step))
      return inconclusive(fmt::format("{} along {} without the step {}", name, kAxisLetters[across], step),
                          'G');
    const std::optional<double> by = pecked(w, step);
    if (!by) return false;
    const double width = std::abs(end[across] - start[across]), side = end[across] < start[across] ? -1 : 1;
    if (width / *by > kMostPecks) return inconclusive(name + " takes too many steps for a run here", step);
    for (double at = *by; at < width - control_->increment / 2; at += *by)
      columns.push_back(snap(start[across] + side * at));
    columns.push_back(end[across]);
  }
  if (depth == 0 || *back >= *peck || depth / *peck * static_cast<double>(columns.size()) > kMostPecks)
    return inconclusive(name + " goes nowhere, goes back by a peck or more, or takes too many of them", 'G');
  Position at = start;
  for (const double column : columns) {
    if (column != at[across]) {
      at[across] = column;
      if (!rapidTo(at)) return false;
    }
    for (double done = 0; done < depth;) {
      const bool last = done + *peck > depth - control_->increment / 2;
      done = last ? depth : done + *peck;
      at[along] = last ? end[along] : snap(start[along] + way * done);
      if (!leg("feed", MotionKind::Feed, at)) return false;
      if (last || *back == 0) continue;
      at[along] = snap(at[along] - way * *back);
      if (!rapidTo(at)) return false;
    }
    at[along] = start[along];
    if (!rapidTo(at)) return false;
  }
  return at[across] == start[across] || rapidTo(start);
}

// G70 outside of a program, G71 to G73, G76: no source that the data rest on states their path.
bool Machine::refusedCycle(const NcWords& w) {
  const std::string name = placed(w.line);
  const bool thread = block_.oneShot == Function::ThreadPasses;
  const bool second = thread ? (w.present & (kAxisBits)) != 0 : (w.present & ir::addressBits("PQ")) != 0;
  if (block_.oneShot != Function::ContourFinish && !second) {
    const std::uint32_t takes = thread ? ir::addressBits("PQR") : ir::addressBits("UWR");
    if ((w.present & (ir::addressBits("ADIKPQR") | kAxisBits) & ~takes) == 0 && (w.present & takes) != 0)
      return true;
    return inconclusive(name + (thread ? " without X and Z is the first of two blocks, and takes P, Q and R"
                                       : " without P and Q is the first of two blocks, and takes U, W and R"),
                        'G');
  }
  if (block_.oneShot == Function::ContourFinish)
    return inconclusive(name + " finishes along blocks of its program, which are not known here", 'G');
  if (!thread && !(w.has('P') && w.has('Q')))
    return inconclusive(name + " with one of P and Q: the contour is from the block N of P to that of Q",
                        'G');
  const bool oneBlock = (w.present & ir::addressBits("ADIK")) != 0;
  return inconclusive(
      fmt::format(
          "{} ({}) moves along a path that no source of Dotek states; for a run here write its passes as "
          "blocks",
          name, oneBlock ? "the form with one block" : "the second of two blocks"),
      'G');
}

bool Machine::finishesContour(const NcWords& w) const {
  return std::any_of(w.g.begin(), w.g.begin() + w.gCount, [&](std::uint32_t code) {
    return code != NcWords::kNoCode && table_.g(code).function == Function::ContourFinish;
  });
}

} // namespace dotek::sim
