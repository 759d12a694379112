#include "sim/machine/Mikroprog.h"

#include "ir/Evaluate.h"
#include "ir/Rewrite.h"
#include "sim/machine/Axes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

namespace {

using stdlib::MikroprogFunction;

constexpr std::string_view kLetters = "XYZ";
constexpr std::uint32_t kAccumulator = 90; // P90: the parameter of conditions and files
constexpr std::size_t kMostEvents = 100'000;
constexpr double kTouching = 1e-9; // share of a move within which the contact is there from the start

// Functions that move nothing and decide nothing here.
bool isQuiet(const std::string& what) {
  for (const std::string_view quiet :
       {"plane-xy", "plane-zx", "plane-yz", "compensation-off", "system-off", "feed-per-minute",
        "spindle-off", "coolant-off", "coolant-on", "spindle-right", "spindle-left", "dwell", "join-off",
        "set-condition", "write-text"})
    if (what == quiet) return true;
  return false;
}

// Number of a code, a block, a condition; a number that cannot be one is none that exists.
std::uint32_t wholeOf(double value) {
  return value >= 0 && value < 1e9 && value == std::floor(value) ? static_cast<std::uint32_t>(value)
                                                                 : UINT32_MAX;
}

Position wide(const std::array<double, 3>& point) {
  Position out{};
  std::copy(point.begin(), point.end(), out.begin());
  return out;
}

} // namespace

MikroprogMachine::MikroprogMachine(const stdlib::MikroprogControl& control, const BlockList& program)
    : control_(control), program_(program) {
  if (!program.refused.empty()) stop(MikroprogEnding::Inconclusive, program.refused);
}

bool MikroprogMachine::stop(MikroprogEnding ending, std::string why) {
  ending_ = ending;
  why_ = std::move(why);
  return false;
}

void MikroprogMachine::event(MikroprogEvent::Kind kind, std::string text, double value) {
  if (events_.size() == kMostEvents) {
    stop(MikroprogEnding::Endless, fmt::format("more than {} contacts, records and stops", kMostEvents));
    return;
  }
  events_.push_back({kind, number_, position(), machine_, value, std::move(text)});
}

std::array<double, 3> MikroprogMachine::position() const {
  return inSystem(machine_);
}

std::array<double, 3> MikroprogMachine::inSystem(const std::array<double, 3>& machine) const {
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = snap(machine[i] - offset_[i]);
  return out;
}

std::string MikroprogMachine::lastStop() const {
  for (auto at = events_.rbegin(); at != events_.rend(); ++at)
    if (at->kind == MikroprogEvent::Kind::Stop) return at->text;
  return "";
}

std::optional<double> MikroprogMachine::parameter(std::uint32_t number) const {
  const auto found = parameters_.find(number);
  return found == parameters_.end() ? std::nullopt : std::optional(found->second);
}

void MikroprogMachine::run(std::uint64_t mostBlocks) {
  for (std::uint64_t done = 0; ending_ == MikroprogEnding::Running; ++done) {
    if (done == mostBlocks) {
      stop(MikroprogEnding::Endless, fmt::format("more than {} blocks", mostBlocks));
    } else if (next_ >= program_.blocks.size()) {
      stop(MikroprogEnding::Inconclusive, "the program has no M30");
    } else {
      const ListedBlock& now = program_.blocks[next_++];
      number_ = now.number.value_or(0);
      line_ = now.line;
      ++blocks_;
      if (trace_ != nullptr) trace_->at(line_);
      block(now);
    }
  }
}

std::optional<double> MikroprogMachine::value(const ir::ExpressionPtr& expression) {
  if (const double* number = ir::constantValue(expression)) return *number;
  std::optional<std::uint32_t> unset;
  const ir::ExpressionPtr known = ir::rewrite(expression, [&](const ir::ExpressionPtr& one) {
    const auto* variable = std::get_if<ir::MachineVariable>(&one->node);
    const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
    if (number == nullptr) return one;
    const auto found = parameters_.find(wholeOf(*number));
    if (found != parameters_.end()) return ir::constant(found->second, one->range);
    if (!unset) unset = wholeOf(*number);
    return one;
  });
  if (unset) {
    stop(MikroprogEnding::Inconclusive, fmt::format("P{} has no value", *unset));
    return std::nullopt;
  }
  const ir::Scalar result = ir::evaluate(*known, {});
  if (result.known()) return result.value;
  stop(MikroprogEnding::Inconclusive,
       result.error == ir::ArithmeticError::DivisionByZero ? "a division by 0" : "a sum without a value");
  return std::nullopt;
}

std::optional<double> MikroprogMachine::word(const ListedBlock& block, char address) {
  for (const ir::Word& one : block.words)
    if (one.address == address) return value(one.value);
  return std::nullopt;
}

bool MikroprogMachine::assign(const ir::Store& store) {
  const std::optional<double> number = value(store.number);
  const std::optional<double> sum = value(store.value);
  if (!number || !sum) return false;
  parameters_[wholeOf(*number)] = snap(*sum);
  return true;
}

// All functions of a block, in the order of the text, then the short form.
bool MikroprogMachine::block(const ListedBlock& block) {
  if (block.store != nullptr) return assign(*block.store);
  std::vector<std::string> functions;
  for (const ir::Word& one : block.words) {
    if (one.address != 'G' && one.address != 'M') continue;
    const double* number = ir::constantValue(one.value);
    const MikroprogFunction* function =
        number == nullptr ? nullptr : control_.find(one.address, wholeOf(*number));
    if (function == nullptr || !function->usable)
      return stop(MikroprogEnding::Inconclusive,
                  fmt::format("{}{} is not known", one.address, number == nullptr ? 0 : *number));
    functions.push_back(function->function);
  }
  bool moves = false;
  for (const std::string& what : functions) {
    moves = moves || what == "rapid" || what == "feed" || what == "probe-move" || what == "set-position";
    if (!function(block, what)) return false;
  }
  const bool axes = std::any_of(block.words.begin(), block.words.end(), [&](const auto& one) {
    return kLetters.find(one.address) != std::string_view::npos;
  });
  if (axes && !moves) return move(block, motion_);
  return true;
}

bool MikroprogMachine::function(const ListedBlock& block, const std::string& what) {
  if (what == "rapid" || what == "feed") {
    motion_ = what;
    return move(block, what);
  }
  if (what == "probe-move") return probe(block);
  if (what == "set-position") return setPosition(block);
  if (what == "absolute" || what == "incremental") {
    incremental_ = what == "incremental";
    return true;
  }
  if (what == "jump") return jump(block);
  if (what == "jump-if") {
    const std::optional<double> number = word(block, 'O');
    if (!number) return stop(MikroprogEnding::Fault, "G23 without O");
    const std::optional<bool> holds = condition(wholeOf(*number));
    return holds && (!*holds || jump(block));
  }
  if (what == "call") return call(block);
  if (what == "return") {
    if (returns_.empty()) return stop(MikroprogEnding::Fault, "M17 without a call");
    next_ = returns_.back();
    returns_.pop_back();
    return true;
  }
  if (what == "record-position" || what == "record-value") {
    if (block.file.empty()) return stop(MikroprogEnding::Fault, "no file");
    const bool position = what == "record-position";
    const auto value = parameters_.find(kAccumulator);
    if (!position && value == parameters_.end())
      return stop(MikroprogEnding::Inconclusive, "P90 has no value");
    event(position ? MikroprogEvent::Kind::Record : MikroprogEvent::Kind::Value, block.file,
          position ? 0 : value->second);
    if (trace_ != nullptr && position) {
      trace_->begin("record").text(block.file).position(wide(this->position()), 7).end();
    } else if (trace_ != nullptr) {
      trace_->begin("record").text(block.file).word("", value->second).end();
    }
    return true;
  }
  if (what == "stop") {
    event(MikroprogEvent::Kind::Stop, block.text);
    if (trace_ != nullptr && !block.text.empty())
      trace_->begin("stop").text(block.text).end();
    else if (trace_ != nullptr)
      trace_->begin("stop").end();
    return true;
  }
  if (what == "end") {
    if (trace_ != nullptr) trace_->begin("end").end();
    return stop(MikroprogEnding::ProgramEnd, "");
  }
  if (what == "spindle-right" || what == "spindle-left" || what == "spindle-off")
    spindle_ = what != "spindle-off";
  if (what == "coolant-on" || what == "coolant-off") coolant_ = what == "coolant-on";
  if (isQuiet(what)) {
    if (trace_ == nullptr) return true;
    if (what == "spindle-right" || what == "spindle-left" || what == "spindle-off")
      trace_->begin("spindle")
          .text(what == "spindle-off"     ? "off"
                : what == "spindle-right" ? "cw"
                                          : "ccw")
          .end();
    else if (what == "coolant-on" || what == "coolant-off")
      trace_->begin("coolant").text(what == "coolant-on" ? "flood" : "off").end();
    return true;
  }
  return stop(MikroprogEnding::Inconclusive,
              what.empty() ? "a function that is not followed" : what + " is not followed");
}

// A word of an axis, X of a lathe as a radius.
std::optional<double> MikroprogMachine::scaled(const ListedBlock& block, std::size_t axis) {
  const std::optional<double> given = word(block, kLetters[axis]);
  if (!given) return std::nullopt;
  if (!control_.hasAxis(kLetters[axis])) {
    stop(MikroprogEnding::Inconclusive, fmt::format("there is no axis {}", kLetters[axis]));
    return std::nullopt;
  }
  return control_.isDiameter(kLetters[axis]) ? *given / 2 : *given;
}

// End point in coordinates of the machine.
bool MikroprogMachine::target(const ListedBlock& block, std::array<double, 3>& to, bool& any) {
  to = machine_;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> given = scaled(block, i);
    if (ending_ != MikroprogEnding::Running) return false;
    if (!given) continue;
    any = true;
    if (incremental_ && control_.isDiameter(kLetters[i]))
      return stop(MikroprogEnding::Inconclusive, "G91 with a diameter (Q9)");
    to[i] = snap(incremental_ ? machine_[i] + *given : offset_[i] + *given);
  }
  return true;
}

SkipMove MikroprogMachine::skipMove(const std::array<double, 3>& to) const {
  SkipMove move{};
  for (std::size_t i = 0; i < 3; ++i) {
    move.machineFrom[i] = machine_[i];
    move.machineTo[i] = to[i];
    move.from[i] = machine_[i] - offset_[i];
    move.to[i] = to[i] - offset_[i];
  }
  move.feed = feed_;
  return move;
}

void MikroprogMachine::tell(MotionKind kind, const std::array<double, 3>& from) {
  if (watcher_ != nullptr) watcher_->moved({kind, wide(from), wide(machine_), line_, true});
}

void MikroprogMachine::traceMove(std::string_view action, bool feed) {
  if (trace_ == nullptr) return;
  trace_->begin(action).position(wide(position()), 7);
  if (feed) trace_->word("F", feed_);
  trace_->end();
}

bool MikroprogMachine::move(const ListedBlock& block, const std::string& motion) {
  if (motion != "rapid" && motion != "feed")
    return stop(MikroprogEnding::Inconclusive, motion + " is not followed");
  if (const std::optional<double> feed = word(block, 'F')) feed_ = *feed;
  std::array<double, 3> to{};
  bool any = false;
  if (!target(block, to, any)) return false;
  if (!any) return true;
  if (motion == "feed" && feed_ <= 0) return stop(MikroprogEnding::Fault, "a feed move with F0");
  if (signal_ != nullptr && watcher_ == nullptr && to != machine_) {
    const std::optional<double> share = signal_->contact(skipMove(to));
    if (share && *share > kTouching && *share < 1 - kTouching) {
      for (std::size_t i = 0; i < 3; ++i)
        machine_[i] += *share * (to[i] - machine_[i]);
      return stop(MikroprogEnding::Crash, "the stylus meets the part in a move that does not watch it");
    }
  }
  const std::array<double, 3> from = machine_;
  machine_ = to;
  traceMove(motion, motion == "feed");
  tell(motion == "rapid" ? MotionKind::Rapid : MotionKind::Feed, from);
  return ending_ == MikroprogEnding::Running;
}

bool MikroprogMachine::probe(const ListedBlock& block) {
  if (signal_ == nullptr) return stop(MikroprogEnding::Inconclusive, "G31 without a part");
  if (incremental_) return stop(MikroprogEnding::Inconclusive, "G31 under G91 (Q20)");
  std::array<double, 3> to{};
  bool any = false;
  if (!target(block, to, any)) return false;
  if (!any) return stop(MikroprogEnding::Fault, "G31 without an axis");
  const std::optional<double> share = to == machine_ ? std::nullopt : signal_->contact(skipMove(to));
  if (ending_ != MikroprogEnding::Running) return false; // who watches has ended it
  if (share && *share <= kTouching) return stop(MikroprogEnding::Inconclusive, "G31 begins in contact (Q19)");
  const std::array<double, 3> from = machine_;
  for (std::size_t i = 0; i < 3; ++i)
    machine_[i] = share ? snap(machine_[i] + *share * (to[i] - machine_[i])) : to[i];
  tell(MotionKind::Skip, from);
  if (trace_ != nullptr) {
    trace_->begin("skip").position(wide(inSystem(to)), 7).text(share ? "contact" : "no-contact");
    trace_->position(wide(position()), 7).end();
  }
  event(share ? MikroprogEvent::Kind::Contact : MikroprogEvent::Kind::NoContact);
  if (share) return true;
  const bool hasTarget =
      std::any_of(block.words.begin(), block.words.end(), [](const auto& one) { return one.address == 'L'; });
  if (!hasTarget) return stop(MikroprogEnding::Fault, "G31 has found nothing");
  return jump(block);
}

bool MikroprogMachine::setPosition(const ListedBlock& block) {
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> given = scaled(block, i);
    if (ending_ != MikroprogEnding::Running) return false;
    if (!given) continue;
    any = true;
    offset_[i] = snap(machine_[i] - *given);
  }
  if (!any) return stop(MikroprogEnding::Fault, "G92 without an axis");
  event(MikroprogEvent::Kind::Datum);
  if (trace_ != nullptr) trace_->begin("set-position").position(wide(position()), 7).end();
  return true;
}

bool MikroprogMachine::jump(const ListedBlock& block) {
  const std::optional<double> number = word(block, 'L');
  if (!number) return stop(MikroprogEnding::Fault, "a jump without L");
  const auto found = program_.numbers.find(wholeOf(*number));
  if (found == program_.numbers.end())
    return stop(MikroprogEnding::Fault, fmt::format("no block N{}", *number));
  next_ = found->second;
  return true;
}

bool MikroprogMachine::call(const ListedBlock& block) {
  const std::optional<double> runs = word(block, 'H');
  if (runs && *runs != 1) return stop(MikroprogEnding::Inconclusive, "G26 with H (Q8)");
  returns_.push_back(next_);
  return jump(block);
}

std::vector<std::uint32_t> MikroprogMachine::openCalls() const {
  std::vector<std::uint32_t> out;
  for (const std::size_t next : returns_)
    out.push_back(program_.blocks[next - 1].line);
  return out;
}

std::optional<bool> MikroprogMachine::condition(std::uint32_t number) {
  if (number == 7) {
    if (signal_ != nullptr) return signal_->isThere(skipMove(machine_));
    stop(MikroprogEnding::Inconclusive, "O7 without a part");
    return std::nullopt;
  }
  if (number < 10 || number > 16) {
    stop(MikroprogEnding::Inconclusive, fmt::format("O{} is an input of the machine", number));
    return std::nullopt;
  }
  const std::optional<double> p = parameter(kAccumulator);
  if (!p) {
    stop(MikroprogEnding::Inconclusive, "P90 has no value");
    return std::nullopt;
  }
  if (number == 10) return *p == 0;
  const std::size_t axis = (number - 11) / 2;
  const bool atMost = *p <= position()[axis] * (control_.isDiameter(kLetters[axis]) ? 2 : 1);
  return number % 2 == 1 ? atMost : !atMost;
}

} // namespace dotek::sim
