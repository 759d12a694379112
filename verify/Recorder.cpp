#include "verify/Recorder.h"

#include "sim/machine/Measurement.h"
#include "sim/machine/Value.h"
#include "stdlib/AlarmMeaning.h"
#include "stdlib/RadiusOffsets.h"
#include "verify/Nominal.h"
#include "verify/RadiusTable.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotek::verify {

using stdlib::Intent;

namespace {

constexpr double kSameSignal = 1e-6; // mm: two signals of one place

bool isFault(sim::Outcome outcome) {
  return outcome != sim::Outcome::Contact && outcome != sim::Outcome::Miss;
}

// Nobody can say what the stylus meets on a move whose beginning is not known, as after G28 with a tool
// length in force. It is no fault of the program.
bool isUnknown(const sim::ProbeEvent& event) {
  return event.outcome == sim::Outcome::NotModelled && event.placeUnknown;
}

// Touches of one place, a fast one and a slow one, are one contact. The ball's middle, since on a narrow bore
// the point lies farther beside.
bool same(const sim::ProbeEvent& a, const sim::ProbeEvent& b, bool oblique) {
  return (a.point - b.point).length() < kSameSignal ||
         (oblique && (a.centre - b.centre).length() < kObliqueWord);
}

} // namespace

bool isOblique(const Measure& measure) {
  return std::any_of(measure.nominal.begin(), measure.nominal.end(),
                     [](const Touch& touch) { return touch.direction.x != 0 && touch.direction.y != 0; });
}

std::optional<double> Measure::letter(char letter) const {
  const std::uint32_t local = stdlib::localOf(letter);
  const auto found = std::find_if(locals.begin(), locals.end(),
                                  [&](const auto& one) { return local != 0 && one.first == local; });
  return found == locals.end() ? std::nullopt : std::optional(found->second);
}

Recorder::Recorder(sim::Machine& machine, sim::World& world, std::vector<const stdlib::MacroSet*> sets,
                   double toolLength)
    : machine_(machine), world_(world), sets_(std::move(sets)), length_(toolLength) {
  using stdlib::Function;
  constexpr Function kModes[] = {Function::PlaneXY, Function::FeedPerMinute, Function::Absolute};
  for (std::size_t i = 0; i < groups_.size(); ++i)
    if (const stdlib::CodeInfo* code = machine.control().find(kModes[i]); code != nullptr && code->group)
      groups_[i] = static_cast<std::uint32_t>(*code->group);
}

std::array<std::uint32_t, 3> Recorder::modes(bool call) const {
  const auto code = [&](std::size_t i) { return groups_[i] == 0 ? 0 : machine_.modalCode(groups_[i]); };
  return {code(0), code(1), call ? code(2) : 0};
}

WorkFrame Recorder::frame() const {
  constexpr std::uint32_t kFirst = 54;
  if (machine_.dialect().holdsTool) return {};
  const sim::Machine::WorkSystem system = machine_.activeSystem();
  return {system.index + (system.extended ? kExtendedSystem : kFirst),
          machine_.machinePosition()[2] - machine_.position()[2] - machine_.activeZero()[2]};
}

sim::Point3 Recorder::lowest(const sim::Position& machine) const {
  return {machine[0], machine[1], machine[2] - length_};
}

sim::Point3 Recorder::offset() const {
  const sim::Position now = machine_.machinePosition();
  const sim::Position& work = machine_.position();
  return {now[0] - work[0], now[1] - work[1], now[2] - work[2] - length_};
}

Surroundings Recorder::surroundings() const {
  const double speed = machine_.spindle() == 0 ? 0 : machine_.spindleSpeed();
  return {probe_, machine_.spindle(), machine_.coolant(), speed};
}

SourceRange Recorder::place() const {
  return place_ ? place_() : SourceRange{};
}

void Recorder::begin(const sim::Run& run, bool keepMoves) {
  run_ = &run;
  begin([&run] { return run.place(); }, keepMoves);
}

namespace {

// Lengths by number; radii, where they are known of the control, from kRadiusTable on.
std::vector<sim::Machine::ToolOffset> toolTable(sim::Machine& machine) {
  std::vector<sim::Machine::ToolOffset> out = machine.toolTable();
  const stdlib::RadiusOffsets radii = stdlib::radiusOffsets(machine.control());
  if (!radii.geometry && !radii.wear) return out;
  const auto last = static_cast<std::uint32_t>(machine.control().variables.toolCount);
  out.resize(kRadiusTable + last + 1);
  const auto read = [&](const std::optional<int>& base, std::uint32_t tool) {
    return base ? machine.read(static_cast<std::uint32_t>(*base) + tool).value_or(0) : 0;
  };
  for (std::uint32_t tool = 1; tool <= last; ++tool)
    out[kRadiusTable + tool] = {read(radii.wear, tool), read(radii.geometry, tool)};
  return out;
}

} // namespace

void Recorder::begin(std::function<SourceRange()> place, bool keepMoves) {
  place_ = std::move(place);
  keepMoves_ = keepMoves;
  extended_ = machine_.extendedZeros();
  record_.start = lowest(machine_.machinePosition());
  record_.before = surroundings();
  record_.feedBefore = machine_.feed();
  tools_ = toolTable(machine_);
  tool_ = machine_.tool();
  if (watchedStores_ != nullptr)
    for (const std::uint32_t number : *watchedStores_)
      storedBefore_.emplace(number, machine_.common(number));
  for (std::uint32_t group = 0; group < record_.modalBefore.size(); ++group)
    record_.modalBefore[group] = machine_.modalCode(group);
}

void Recorder::probeSwitched(bool on) {
  if (call_.depth == 0) record_.switches.push_back({0, modes(true), surroundings(), place()});
  world_.probeSwitched(on);
  probe_ = on ? Switch::On : Switch::Off;
}

// By how much the signal came beside the place of each surface, along the axes that the call has set.
void Recorder::movePath(const Measure& measure) {
  std::array<double, 3> off{};
  std::array<int, 3> touches{};
  const double radius = world_.probe().ballRadius();
  for (std::size_t i = call_.moved; i < measure.nominal.size() && i < call_.signals.size(); ++i) {
    const sim::Point3 direction = measure.nominal[i].direction;
    const sim::Point3 meant = measure.drawn ? *measure.drawn : measure.nominal[i].point;
    const sim::Point3 beside = call_.signals[i] + direction * radius - meant;
    const double along[] = {direction.x, direction.y, direction.z}, by[] = {beside.x, beside.y, beside.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::abs(std::abs(along[axis]) - 1) > 1e-9) continue;
      off[axis] += by[axis];
      ++touches[axis];
    }
  }
  std::array<bool, 3> done{};
  for (const auto& [key, zero] : measure.datums) {
    const std::size_t axis = key.second;
    if (touches[axis] == 0 || std::exchange(done[axis], true)) continue;
    const double by = off[axis] / touches[axis];
    machine_.moveZero(axis, by);
    pathMoved_[axis] += by;
    record_.pathMoved = true;
  }
}

void Recorder::mark(Mark::Kind kind, std::string_view text, double value) {
  const sim::Point3 at = lowest(machine_.machinePosition());
  record_.marks.push_back({kind, record_.pieces.size(), at, offset(), value, std::string(text), place()});
}

// What a macro does by itself is its own business.
void Recorder::note(Deed::Kind kind, double value, std::string_view text) {
  if (call_.depth > 0) return;
  record_.deeds.push_back({kind, value, std::string(text), lowest(machine_.machinePosition()),
                           record_.measures.size(), surroundings(), place()});
  for (const auto& [name, writes] : record_.offsetWrites)
    if (kind == Deed::Kind::Stop && name.starts_with('G')) record_.deeds.back().written.insert(name);
}

void Recorder::addPiece(sim::PathKind kind, const sim::Point3& from, const sim::Point3& to,
                        SourceRange range) {
  Piece piece{kind, from, to, surroundings(), range, std::nullopt, modes(false), frame()};
  if (kind != sim::PathKind::Rapid) piece.feed = machine_.feed();
  record_.pieces.push_back(std::move(piece));
}

// The macro computes from where the machine has stopped, whatever of the probe has touched.
void Recorder::noteSignal(const sim::ProbeEvent& event) {
  const bool stem = event.outcome == sim::Outcome::StemCollision && event.kind == sim::MotionKind::Skip;
  if (!call_.measures || !world_.on() || !(stem || event.outcome == sim::Outcome::Contact)) return;
  const double same = isOblique(record_.measures.back()) ? kObliqueWord : kSameSignal;
  if (call_.signals.empty() || (call_.signals.back() - event.centre).length() > same)
    call_.signals.push_back(event.centre);
}

void Recorder::takeEvents() {
  const std::vector<sim::ProbeEvent>& all = world_.events();
  const SourceRange range = call_.depth > 0 ? call_.range : place();
  for (; events_ < all.size(); ++events_) {
    const sim::ProbeEvent& event = all[events_];
    if (isUnknown(event)) continue;
    noteSignal(event);
    if (isFault(event.outcome)) {
      record_.events.emplace_back(event, range);
    } else if (event.outcome == sim::Outcome::Contact && !record_.measures.empty()) {
      const bool measuring = call_.depth == 0 ? !positions_ : call_.measures;
      Measure& measure = record_.measures.back();
      const bool again = !measure.contacts.empty() &&
                         same(measure.contacts.back(), event, call_.depth > 0 && isOblique(measure));
      if (measuring && !again) measure.contacts.push_back(event);
    }
  }
}

void Recorder::moved(const sim::MachineMotion& motion) {
  const sim::Point3 from = lowest(motion.from), to = lowest(motion.to);
  const bool skip = motion.kind == sim::MotionKind::Skip;
  sim::PathKind kind = motion.kind == sim::MotionKind::Rapid ? sim::PathKind::Rapid : sim::PathKind::Feed;
  if (skip)
    kind =
        call_.moves || (call_.depth == 0 && positions_) ? sim::PathKind::Protected : sim::PathKind::Measuring;
  if (call_.depth == 0) {
    noteLocals();
    if (kind == sim::PathKind::Measuring) {
      Measure measure;
      measure.start = from;
      measure.end = to;
      measure.with = surroundings();
      measure.range = place();
      measure.aim = aim_;
      measure.travels = true;
      record_.measures.push_back(std::move(measure));
    }
    addPiece(kind, from, to, place());
  }
  if (rehearsal_) return;
  world_.moved(motion);
  takeEvents();
  if (keepMoves_) {
    sim::PictureMove move;
    move.kind = kind;
    move.from = world_.centreAt(motion.from);
    move.to = world_.centreAt(motion.to);
    move.probeOn = world_.on();
    record_.moves.push_back(move);
  }
}

Measure Recorder::begunMeasure() {
  for (std::uint32_t system = 0; system < call_.zeros.size(); ++system)
    call_.zeros[system] = machine_.zeroOf(system);
  Measure out;
  out.start = call_.start;
  out.with = call_.with;
  out.range = call_.range;
  return out;
}

void Recorder::callBegins(std::uint32_t program, std::span<const double> locals) {
  if (call_.depth > 0) {
    ++call_.depth;
    return;
  }
  const auto set = std::find_if(sets_.begin(), sets_.end(),
                                [&](const stdlib::MacroSet* one) { return one->calls(program); });
  if (set == sets_.end()) return;
  call_.depth = 1;
  call_.program = program;
  call_.range = place();
  call_.start = lowest(machine_.machinePosition());
  call_.with = surroundings();
  call_.modes = modes(true);
  call_.frame = frame();
  const stdlib::MacroSignature* const signature = signatureOf(**set, program, locals);
  const Intent intent = signature == nullptr ? Intent::Surface : signature->intent;
  call_.moves = intent == Intent::ProtectedMove;
  for (std::uint32_t number = 1; call_.moves && number < locals.size(); ++number)
    if (!sim::isNull(locals[number]) && !sim::isUnknown(locals[number])) call_.given[number] = locals[number];
  if (const stdlib::MacroArgument* flag =
          signature == nullptr || !call_.moves ? nullptr : signature->find(stdlib::ArgumentRole::FlagOnly))
    call_.goesOn = locals[stdlib::localOf(flag->letter)] == 1;
  if (const stdlib::MacroArgument* feed =
          signature == nullptr ? nullptr : signature->find(stdlib::ArgumentRole::Feed)) {
    const double given = locals[stdlib::localOf(feed->letter)];
    if (!sim::isNull(given) && !sim::isUnknown(given)) call_.feed = given;
  }
  const bool switches = intent == Intent::ProbeOn || intent == Intent::ProbeOff;
  if (switches) record_.switches.push_back({program, call_.modes, call_.with, call_.range});
  call_.measures = !call_.moves && !switches;
  if (!call_.measures) return;
  Measure measure = begunMeasure();
  measure.program = program;
  for (std::uint32_t number = 1; number < locals.size(); ++number)
    if (!sim::isNull(locals[number]) && !sim::isUnknown(locals[number]))
      measure.locals.emplace_back(number, locals[number]);
  if (signature != nullptr) {
    noteSystem(*signature, locals);
    noteOptions(*signature, locals, measure);
    const sim::Position& at = machine_.position();
    measure.nominal = nominalTouches(*signature, locals, {at[0], at[1], at[2]}, world_.probe().ballRadius());
    for (Touch& touch : measure.nominal)
      touch.point = touch.point + offset();
    measure.drawn = drawnOnWay(measure);
  }
  record_.measures.push_back(std::move(measure));
}

void Recorder::callUnstated(std::string_view what, std::span<const double> /*locals*/) {
  if (call_.depth == 0 || !call_.measures) return;
  Measure& measure = record_.measures.back();
  measure.unstated = what;
}

// A datum that moves nothing is one, too.
void Recorder::noteSystem(const stdlib::MacroSignature& signature, std::span<const double> locals) {
  const auto given = [&](const stdlib::MacroArgument* argument) {
    const std::uint32_t local = argument == nullptr ? 0 : stdlib::localOf(argument->letter);
    const bool there = local != 0 && local < locals.size() && !sim::isNull(locals[local]);
    return there ? std::optional(locals[local]) : std::nullopt;
  };
  const stdlib::MacroArgument* const system = signature.find(stdlib::ArgumentRole::System);
  const std::optional<double> value = given(system);
  if (!value) return;
  const double number = system->systemCode == stdlib::SystemCode::Index ? *value + 53 : *value;
  if (!(number >= 54 && number <= 59)) return;
  call_.system = static_cast<std::uint32_t>(number);
  for (const ir::Axis axis : ir::kAxes)
    call_.names[ir::indexOf(axis)] = given(signature.find(stdlib::ArgumentRole::Nominal, axis)).has_value();
}

// Roles that the nominal contacts and the datum show already are none.
void Recorder::noteOptions(const stdlib::MacroSignature& signature, std::span<const double> locals,
                           Measure& measure) const {
  using stdlib::ArgumentRole;
  const auto given = [&](const stdlib::MacroArgument& argument) {
    const std::uint32_t local = stdlib::localOf(argument.letter);
    return local < locals.size() && !sim::isNull(locals[local]) && !sim::isUnknown(locals[local]);
  };
  for (const stdlib::MacroArgument& argument : signature.arguments) {
    if (argument.role == ArgumentRole::Target && argument.frame == ir::Frame::Here && given(argument))
      measure.travels = true;
    switch (argument.role) {
    case ArgumentRole::Feed:
    case ArgumentRole::Overtravel:
    case ArgumentRole::Clearance:
    case ArgumentRole::FlagOnly:
    case ArgumentRole::Tool:
    case ArgumentRole::SpareTool:
    case ArgumentRole::Experience:
    case ArgumentRole::SizeTolerance:
    case ArgumentRole::PositionTolerance:
    case ArgumentRole::AngleTolerance:
    case ArgumentRole::UpperLimit:
    case ArgumentRole::NullBand:
    case ArgumentRole::Feedback:
    case ArgumentRole::Print:
    case ArgumentRole::Task:
    case ArgumentRole::Number:
    case ArgumentRole::Unstated: break;
    default: continue;
    }
    if (given(argument)) measure.options[argument.role] = locals[stdlib::localOf(argument.letter)];
  }
}

void Recorder::noteDatums(Measure& measure) const {
  for (std::uint32_t system = 0; system < call_.zeros.size(); ++system) {
    const sim::Position now = machine_.zeroOf(system);
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      if (now[axis] != call_.zeros[system][axis] ||
          (machine_.running() && 54 + system == call_.system && call_.names[axis]))
        measure.datums.try_emplace({54 + system, axis}, now[axis]);
  }
}

// What is still to be touched lies where the moved path leads.
void Recorder::touchedApart() {
  if (call_.depth == 0 || !call_.measures || !datumsMovePath_) return;
  takeEvents();
  Measure& measure = record_.measures.back();
  noteDatums(measure);
  const sim::Point3 before = offset();
  movePath(measure);
  const sim::Point3 by = offset() - before;
  // The zero of the active system is no datum for that it moves.
  for (std::uint32_t system = 0; system < call_.zeros.size(); ++system)
    call_.zeros[system] = machine_.zeroOf(system);
  call_.moved = std::max<std::size_t>(call_.signals.size(), 1);
  for (std::size_t i = call_.moved; i < measure.nominal.size(); ++i)
    measure.nominal[i].point = measure.nominal[i].point + by;
}

void Recorder::endCall() {
  takeEvents();
  const sim::Point3 end = lowest(machine_.machinePosition());
  if (call_.measures) {
    Measure& measure = record_.measures.back();
    if (call_.moved == 0) noteDatums(measure);
    if (datumsMovePath_ && machine_.running() && call_.moved == 0) movePath(measure);
    measure.end = lowest(machine_.machinePosition());
    record_.pieces.push_back({sim::PathKind::Measuring, call_.start, call_.start, call_.with, call_.range,
                              std::nullopt, call_.modes, call_.frame});
  } else if (call_.moves) {
    if (machine_.running() && (end - call_.start).length() <= kSameSignal)
      record_.idle.push_back(
          {call_.program, record_.pieces.size(), call_.feed, std::move(call_.given), call_.range});
    record_.pieces.push_back({sim::PathKind::Protected, call_.start, end, call_.with, call_.range, call_.feed,
                              call_.modes, call_.frame, call_.goesOn});
  }
  call_ = {};
}

void Recorder::callEnded(std::uint32_t /*program*/) {
  if (call_.depth == 0 || --call_.depth > 0) return;
  endCall();
  noteLocals();
}

// Those of the level that moves or has called.
void Recorder::noteLocals() {
  if (!record_.locals.empty()) return;
  record_.locals.assign(static_cast<std::size_t>(machine_.control().locals) + 1, sim::kNull);
  for (std::uint32_t number = 1; number < record_.locals.size(); ++number)
    record_.locals[number] = machine_.local(number);
}

// What a cycle does by itself counts as one thing, as a call of a macro does.
void Recorder::beginOwn() {
  call_.depth = 1;
  call_.range = place();
  call_.start = lowest(machine_.machinePosition());
  call_.with = surroundings();
  call_.modes = modes(true);
  call_.frame = frame();
}

void Recorder::endOwn() {
  if (call_.depth == 0) return;
  call_.depth = 0;
  endCall();
}

void Recorder::protectedBegins(std::optional<double> feed) {
  beginOwn();
  call_.moves = true;
  call_.feed = feed;
}

void Recorder::touchBegins(std::span<const sim::PlannedTouch> touches) {
  beginOwn();
  call_.measures = true;
  Measure measure = begunMeasure();
  for (const sim::PlannedTouch& touch : touches) {
    const sim::Point3 direction{touch.direction[0], touch.direction[1], touch.direction[2]};
    sim::Point3 point = sim::Point3{touch.from[0], touch.from[1], touch.from[2]} + offset();
    // Straight down the lowest point touches, else the ball at the height of its centre.
    if (!touch.isDown()) point.z += world_.probe().ballRadius();
    measure.nominal.push_back({point + direction * touch.distance, direction});
    if (touch.stated) measure.options[stdlib::ArgumentRole::Overtravel] = touch.overtravel;
  }
  record_.measures.push_back(std::move(measure));
}

void Recorder::offsetWritten(const sim::OffsetWrite& write) {
  constexpr std::string_view kAxes = "XYZ";
  const std::size_t axis = write.name.size() > 1 && write.name[write.name.size() - 2] == ' '
                               ? kAxes.find(write.name.back())
                               : std::string_view::npos;
  if (call_.depth == 0 && axis != std::string_view::npos && !record_.ownOffsets[axis])
    record_.ownOffsets[axis] = record_.measures.size();
  std::string name = write.name;
  // Length, geometry and wear make one offset.
  if (name.starts_with("tool ")) {
    const bool radius = name.find(" radius") != std::string::npos;
    name = (radius ? "radius of " : "") + name.substr(0, name.find(' ', 5));
  }
  constexpr std::size_t kMost = 64;
  std::vector<Write>& all = record_.offsetWrites[name];
  if (all.size() == kMost) all.pop_back();
  all.push_back({name.ends_with(" X") || name.ends_with(" Y") || name.ends_with(" Z")
                     ? write.after
                     : write.after - write.before,
                 call_.depth > 0 ? call_.range : place(), record_.pieces.size()});
}

Record Recorder::finish(const std::set<std::uint32_t>& stores) {
  const sim::RunEnd& end = machine_.end();
  switch (end.ending) {
  case sim::Ending::ProgramEnd:
  case sim::Ending::TextEnd:
  case sim::Ending::Return: record_.ending = Ending::Finished; break;
  case sim::Ending::Alarm: record_.ending = Ending::Alarm; break;
  default: record_.ending = Ending::Inconclusive; break;
  }
  record_.overLimit = end.ending == sim::Ending::Limit;
  record_.ofValue = end.ofValue;
  if (record_.ending != Ending::Finished) {
    record_.alarm = end.number;
    // Two controls show the alarm of one macro by different numbers.
    if (const std::uint32_t from = machine_.control().alarmShown;
        end.number >= from && end.number - from <= 999)
      record_.alarm = 3000 + end.number - from;
    record_.text = end.text;
    record_.endedAt = call_.depth > 0 ? call_.range : place();
    if (call_.depth > 0) {
      record_.alarmKind = alarmKindOf(end);
      endCall();
    }
  }
  takeEvents();
  record_.end = lowest(machine_.machinePosition());
  record_.after = surroundings();
  if (machine_.tool() != tool_) record_.tool = machine_.tool();
  for (std::uint32_t group = 0; group < record_.modalAfter.size(); ++group)
    record_.modalAfter[group] = machine_.modalCode(group);
  if (const sim::Rotation& turn = machine_.rotation(); turn.on()) {
    const sim::Position zero = turn.turned({});
    record_.turn = {turn.degrees(), zero[0], zero[1], zero[2]};
  }
  record_.feedAfter = machine_.feed();
  record_.motionOfMacro = !machine_.knowsMotion();
  record_.feedOfMacro = !machine_.knowsFeed();
  record_.lastBlock = place();
  noteEarlyUses();
  // Of the additional systems those that were changed: not every control has as many.
  const std::vector<sim::Position>& extended = machine_.extendedZeros();
  for (std::uint32_t number = 1; number < extended.size(); ++number)
    for (std::uint32_t axis = 0; axis < sim::kAxes; ++axis)
      if (extended[number][axis] != extended_[number][axis])
        record_.zeros[{kExtendedSystem + number, axis}] = extended[number][axis];
  for (std::uint32_t system = 0; system < 6; ++system) {
    const sim::Position zero = machine_.zeroOf(system);
    for (std::uint32_t axis = 0; axis < sim::kAxes; ++axis)
      if (axis < 3 || zero[axis] != 0) record_.zeros[{54 + system, axis}] = zero[axis]; // others begin at 0
  }
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    record_.zeros[{52, axis}] = machine_.localShift()[axis];
    record_.zeros[{92, axis}] = machine_.positionShift()[axis];
  }
  const std::vector<sim::Machine::ToolOffset> tools = toolTable(machine_);
  for (std::uint32_t number = 1; number < tools.size(); ++number)
    if (number >= tools_.size() || tools[number] != tools_[number])
      record_.tools.emplace(number, tools[number]);
  for (const std::uint32_t number : stores) {
    const double value = machine_.common(number);
    if (sim::isFresh(value)) continue;
    record_.stores.emplace(number, value);
    if (run_ == nullptr) continue;
    std::vector<Write> writes;
    for (const sim::Run::Written& one : run_->writesOf(number))
      writes.push_back({one.value, one.range});
    if (!writes.empty()) record_.storeWrites.emplace(number, std::move(writes));
  }
  record_.knowsStores = run_ != nullptr;
  const auto same = [](double one, double other) {
    const auto unset = [](double value) { return sim::isFresh(value) || sim::isNull(value); };
    return one == other || (unset(one) && unset(other)) || (sim::isUnknown(one) && sim::isUnknown(other));
  };
  for (const auto& [number, before] : storedBefore_)
    if (const double value = machine_.common(number); !same(before, value))
      record_.strays.emplace(number, value);
  return std::move(record_);
}

// The end point of a block does not wait for the motion to it.
void Recorder::noteEarlyUses() {
  if (run_ == nullptr) return;
  constexpr std::uint32_t kPositions = 20; // variables of one kind
  const std::optional<int> end = machine_.control().variables.blockEnd;
  for (const sim::EarlyRead& read : run_->earlyReads())
    if (!end || read.number - static_cast<std::uint32_t>(*end) >= kPositions)
      record_.early.push_back({read.range, read.number, false});
  for (const sim::EarlyRead& write : run_->earlyWrites())
    record_.early.push_back({write.range, write.number, true});
}

// What the macros of all sets call the same: no contact, an obstructed path.
std::string Recorder::alarmKindOf(const sim::RunEnd& end) const {
#define DOTEK_VERIFY_ALARM(id, name) stdlib::MacroAlarm::id,
  static constexpr stdlib::MacroAlarm kAlarms[] = {DOTEK_MACRO_ALARMS(DOTEK_VERIFY_ALARM)};
#undef DOTEK_VERIFY_ALARM
  for (const stdlib::MacroSet* set : sets_) {
    for (const stdlib::MacroAlarm alarm : kAlarms) {
      const stdlib::MacroAlarmInfo* const info = set->find(alarm);
      const bool same = info == nullptr ? end.number == 0 && end.text == stdlib::macroAlarmText(alarm)
                        : info->number  ? end.number == machine_.control().alarmShown + *info->number &&
                                             end.text == info->text
                                       : end.number == 0 && end.text == info->text;
      if (same) return std::string(stdlib::macroAlarmName(alarm));
    }
  }
  return "";
}

} // namespace dotek::verify
