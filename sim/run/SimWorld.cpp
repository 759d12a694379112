#include "sim/run/SimWorld.h"

#include "project/Job.h"
#include "sim/geometry/PartFile.h"
#include "sim/machine/EndText.h"
#include "sim/picture/PictureReport.h"
#include "sim/run/SetupRun.h"
#include "sim/run/SimReport.h"
#include "stdlib/SetupDatum.h"
#include "stdlib/Toml.h"
#include "support/Decimal.h"
#include "support/Printable.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Part.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace dotek::sim {
namespace {

constexpr std::string_view kRotary =
    "an axis besides X, Y and Z is off zero; where the part is then is not known";
constexpr std::string_view kNowhere = "where the machine is in this move is not known, so what it meets is "
                                      "not";

// A probe that is on, from the gauge line down to the tip of its ball.
MachineFile bareStylus(double diameter, double length) {
  MachineFile out;
  out.probe.ballDiameter = diameter;
  out.probe.effectiveRadius = diameter / 2;
  out.probe.length = length;
  return out;
}

// Of what is in the spindle before any T: the probe, unless the file has numbers for it and for other tools.
double lengthWithoutTool(const std::optional<MachineFile>& machine) {
  if (!machine || (machine->devices.probeTool && !machine->devices.tools.empty())) return 0;
  return machine->probe.length;
}

// [setup] of --job; empty without one. nullopt: reported.
std::optional<Setup> setupOfJob(Session& session) {
  const std::optional<std::string>& path = session.options().job;
  if (!path) return Setup();
  std::optional<project::Job> job = project::loadJob(*path, session);
  if (!job) return std::nullopt;
  return std::move(job->setup);
}

} // namespace

std::unique_ptr<SimWorld> SimWorld::load(const SimOptions& options, Session& session,
                                         std::string_view command) {
  std::unique_ptr<SimWorld> out(new SimWorld(options, session));
  out->picture_ = options.svg || options.html;
  if (!out->loadStockFile()) return nullptr;
  std::optional<Setup> given = setupOfJob(session);
  if (!given) return nullptr;
  given->override(options.setup);
  const bool stylus = given->ballDiameter && given->length;
  if (options.part && !options.machine && !stylus) {
    session.diagnostics().report<diag::MissingOption>(
        {}, command, "--machine MACHINE.toml, or --tool 1 --length L --diameter D",
        "what touches the part of `--part` is a stylus of that length and that diameter of its ball");
    return nullptr;
  }
  if (!out->takeBall(*given)) return nullptr;
  out->setup_ = *given;
  if (!options.machine && !stylus) return out;
  if (!options.machine) out->machine_ = bareStylus(*given->ballDiameter, *given->length);
  return out->loadFiles(*given) ? std::move(out) : nullptr;
}

std::unique_ptr<SimWorld> SimWorld::loadForCycle(const SimOptions& options, const Probe& stylus,
                                                 Session& session) {
  std::unique_ptr<SimWorld> out(new SimWorld(options, session));
  out->picture_ = options.svg || options.html;
  out->subject_ = "cycle";
  std::optional<Setup> given = setupOfJob(session);
  if (!given) return nullptr;
  given->override(options.setup);
  if (!out->takeBall(*given)) return nullptr;
  if (!options.machine) {
    out->machine_ = MachineFile();
    out->machine_->probe = stylus;
    if (given->ballDiameter) {
      out->machine_->probe.ballDiameter = *given->ballDiameter;
      out->machine_->probe.effectiveRadius = *given->ballDiameter / 2;
    }
    if (given->length) out->machine_->probe.length = *given->length;
  }
  if (!out->loadFiles(*given)) return nullptr;
  Setup& setup = out->setup_;
  if (!setup.tool) setup.tool = 1;
  // Z of a cycle is the lowest point of the ball, whatever the length of the probe counts to.
  const Probe& probe = out->machine_->probe;
  if (!given->length) setup.length = probe.centreLength() + probe.ballRadius();
  if (!setup.at && !options.machine) setup.at = {0, 0, 0};
  return out;
}

// false: reported.
bool SimWorld::takeBall(const Setup& given) {
  if (!options_.machine || !given.ballDiameter) return true;
  session_.diagnostics().report<diag::SetupFlag>(
      {}, "--diameter", "the ball's diameter is that of [probe] in the machine's file; write it there");
  return false;
}

// The files of --machine and --part, and what they say of the setup. false: reported.
bool SimWorld::loadFiles(const Setup& given) {
  std::optional<PartFile> part;
  if (options_.machine)
    machine_ = loadMachine(*options_.machine, session_.limits(), session_.sources(), session_.diagnostics());
  if (options_.part)
    part = loadPart(*options_.part, session_.limits(), session_.bounds(folderOf(*options_.part)),
                    session_.sources(), session_.diagnostics());
  if (!machine_ || (options_.part && !part)) return false;
  if (!machine_->hasProbe && (options_.part || subject_ == "cycle")) {
    session_.diagnostics().report<diag::SetupFlag>(
        {}, "--machine", "it has no [probe], and a probe is what touches a part; docs/part.md has the table");
    return false;
  }
  setup_ = machine_->setup;
  // A machine's file serves runs without a part, too.
  if (!part)
    std::erase_if(setup_.zeros, [&](const Setup::Zero& zero) {
      if (zero.ofPart && zero.system != stdlib::kDatum) zeroLeftOut_ = static_cast<std::uint8_t>(zero.system);
      return zero.ofPart;
    });
  setup_.override(given);
  if (std::any_of(setup_.zeros.begin(), setup_.zeros.end(),
                  [&](const Setup::Zero& zero) { return zeroLeftOut_ == zero.system; }))
    zeroLeftOut_.reset();
  // A macro that is called has its tool in the spindle, and [probe] says which that is.
  if (!setup_.call.empty() && !setup_.tool) setup_.tool = machine_->devices.probeTool;
  if (setup_.length && !setup_.tool) {
    session_.diagnostics().report<diag::SetupFlag>({}, "--length",
                                                   "it is the length of a tool; `--tool N` says of which");
    return false;
  }
  for (const auto& [number, length] : setup_.tools)
    if (setup_.tool == number && !given.length && !machine_->setup.length) setup_.length = length;
  // The probe is the tool, unless it is said to be longer or shorter in the table.
  if (setup_.tool && !setup_.length) {
    const CuttingTool* const tool = machine_->devices.find(*setup_.tool);
    setup_.length = tool != nullptr ? tool->length : machine_->probe.length;
  }
  if (part) partZero_ = {part->nominal.shift.x, part->nominal.shift.y, part->nominal.shift.z};
  world_.emplace(part ? part->part : Part(), machine_->probe, machine_->limits);
  world_->setDevices(machine_->devices);
  if (part) clearance_.emplace(nearDistance(part->part));
  return true;
}

void SimWorld::begin() {
  log_.begin({block_ ? block_ : [this] { return blockNow(); },
              [this] {
                const std::size_t moves = recorder_ ? recorder_->picture().moves.size() : 0;
                return moves == 0 ? 0 : moves - 1;
              },
              [this] { return frame_().name; }});
  if (!picture_) return;
  Picture picture;
  picture.title = options_.program;
  picture.date = options_.date;
  picture.control = control_;
  if (world_ && !world_->part().isEmpty()) picture.part = world_->part();
  if (world_) picture.probe = world_->probe();
  picture.probeStated = world_.has_value() && machine_.has_value() && machine_->hasProbe;
  if (machine_) picture.setter = machine_->devices.setter;
  picture.decimals = decimals_;
  recorder_.emplace(
      std::move(picture), world_ ? &*world_ : nullptr,
      callKind_ ? callKind_
                : [](std::uint32_t, std::span<const double>) { return std::optional<PathKind>(); },
      block_ ? block_ : [this] { return blockNow(); });
  recorder_->setFrame(frame_);
  if (machineNow_ != nullptr && (setup_.at || machine_))
    recorder_->setPlace([this] {
      const Position gauge = machineNow_->machinePosition();
      return world_ ? world_->centreAt(gauge) : Point3{gauge[0], gauge[1], gauge[2]};
    });
  recorder_->setSafeMove(safe_);
}

bool SimWorld::prepare(Machine& machine) const {
  // The offset of the probe is its length, unless something else says it.
  if (machine_ && machine_->devices.probeTool) {
    const std::uint32_t tool = *machine_->devices.probeTool;
    const auto most = static_cast<std::uint32_t>(machine.control().variables.toolCount);
    if (tool <= most && machine.toolLengthOf(tool) == 0) machine.setToolLength(tool, machine_->probe.length);
  }
  return sim::prepare(setup_, partZero_, machine, session_.diagnostics()) &&
         (options_.activeSystem == 0 || activate(options_.activeSystem, machine, session_.diagnostics()));
}

Position SimWorld::startOf(const Machine& machine) const {
  if (const auto start = sim::startOf(setup_, machine, lengthWithoutTool(machine_))) return *start;
  Position out{};
  if (machine_) std::copy(machine_->start.begin(), machine_->start.end(), out.begin());
  return out;
}

bool SimWorld::startsWithinTravel(const Machine& machine) const {
  if (!machine_ || sim::startsWithinTravel(setup_, lengthWithoutTool(machine_),
                                           options_.setup.at ? "--at" : "at` of `[setup]",
                                           zeroLeftOut_ == machine.activeSystem().index, machine_->limits,
                                           machine, session_.diagnostics()))
    return true;
  noteZeroLeftOut(session_.diagnostics().all().back());
  return false;
}

void SimWorld::attach(Machine& machine) {
  machineNow_ = &machine;
  if (const stdlib::Control& control = machine.control(); subject_ == "program")
    control_ = control.title.empty() ? control.name : fmt::format("{} ({})", control.title, control.name);
  position_ = [&machine] {
    Position at = machine.position();
    if (machine.dialect().showsDiameters) at[0] *= 2;
    return at;
  };
  start_ = startOf(machine);
  startSystem_ = machine.activeSystem().index;
  if (machine_)
    for (const CuttingTool& tool : machine_->devices.tools)
      lengthsBefore_[tool.number] = machine.toolLengthOf(tool.number);
  if (setup_.at || machine_) machine.startAt(start_);
  tellZeroLeftOut(machine);
  if (!isActive()) {
    // Records and stops are of interest without a part, too.
    if (!machine.dialect().firstParameter && !keepsOffsets_) return;
    if (keepsOffsets_) {
      frame_ = [&machine] { return frameOf(machine); };
      decimals_ = machine.control().decimals;
      begin();
    }
    machine.setWatcher(this);
    return;
  }
  line_ = [&machine] { return machine.frame().line; };
  blocks_ = [&machine] { return machine.blocks(); };
  stop_ = [&machine](std::string why) { machine.inconclusive(std::move(why)); };
  alarm_ = [&machine](std::string text) { machine.raiseUnnumbered(text); };
  stopAt_ = [&machine](const Position& at) { machine.stopAt(at); };
  end_ = [&machine] { return machine.end(); };
  frame_ = [&machine] { return frameOf(machine); };
  work_ = [&machine] {
    const Position& at = machine.position();
    return Point3{machine.dialect().showsDiameters ? 2 * at[0] : at[0], at[1], at[2]};
  };
  decimals_ = machine.dialect().wordDecimals.value_or(machine.control().decimals);
  stockTool_ = machine.tool() != 0 ? machine.tool() : setup_.tool.value_or(0);
  if (world_) world_->toolChanged(machine.tool());
  // The zero of a Mikroprog is set by the program, at a contact.
  if (!machine.dialect().firstParameter)
    systemNow_ = [&machine]() -> std::optional<std::uint32_t> {
      const std::uint8_t system = machine.mode(kSystem);
      if (!machine.isAtMachineZero() || system == kExtended) return std::nullopt;
      return system;
    };
  if (world_ && machine_->hasProbe) machine.setSkipSignal(this);
  machine.setWatcher(this);
  begin();
}

std::optional<double> SimWorld::calibratedRadius() const {
  if (!machine_) return std::nullopt;
  return machine_->probe.effectiveRadius - machine_->probe.preTravel;
}

void SimWorld::checkSystem() {
  if (offsetTold_ || !partZero_ || *partZero_ == std::array<double, 3>{} || !systemNow_) return;
  const std::optional<std::uint32_t> system = systemNow_();
  if (!system) return;
  offsetTold_ = true;
  const std::string name = fmt::format("G{}", 54 + *system);
  session_.diagnostics().report<diag::WorkOffsetNotSet>(place_().range, name, name);
}

void SimWorld::toolChanged(std::uint32_t number) {
  stopSpindle();
  stockTool_ = number;
  // The correction of the tool is in force with it, and coordinates go on at its end.
  const CuttingTool* const tool = machine_ ? machine_->devices.find(number) : nullptr;
  const bool isProbe = machine_ && machine_->devices.probeTool == number;
  if ((tool != nullptr || isProbe) && machineNow_ != nullptr && machineNow_->dialect().holdsTool)
    machineNow_->holdTool(tool != nullptr ? tool->length : machine_->probe.length);
  if (world_) world_->toolChanged(number);
}

void SimWorld::lengthNotSet(std::uint32_t offset) {
  if (!machine_ || !lengthsTold_.insert(offset).second) return;
  const CuttingTool* const tool = machine_->devices.find(offset);
  session_.diagnostics().report<diag::ToolLengthNotSet>(
      place_().range, offset, offset, numberText(tool != nullptr ? tool->length : machine_->probe.length));
}

std::optional<double> SimWorld::contact(const SkipMove& move) {
  if (!world_) return std::nullopt;
  checkSystem();
  checkSpindle();
  searchWay_ = {move.machineTo[0] - move.machineFrom[0], move.machineTo[1] - move.machineFrom[1],
                move.machineTo[2] - move.machineFrom[2]};
  const std::optional<Missed> approach = beginSearch(move);
  world_->setLine(line_());
  if (device_ != nullptr) device_->touchBegins();
  const SkipMove real = shifted(move);
  takeLength();
  motion_ = {move.machineFrom, move.machineTo};
  const std::optional<double> share = recorder_ ? recorder_->contact(real) : world_->contact(real);
  if (device_ != nullptr && share) {
    Position at{};
    for (std::size_t i = 0; i < kAxes; ++i)
      at[i] = move.machineFrom[i] + (move.machineTo[i] - move.machineFrom[i]) * *share;
    device_->touched(at);
  }
  if (approach && share)
    takeBackMiss(*approach);
  else if (approach)
    tellMiss(*approach);
  touched_ = share && !move.positions && !isProtected();
  takeEvents();
  return share;
}

bool SimWorld::isThere(const SkipMove& here) {
  return world_ && world_->isThere(shifted(here));
}

void SimWorld::moved(const MachineMotion& motion) {
  if (isBesideItsPath()) return;
  if (device_ != nullptr) device_->moved(motion.from, motion.to);
  if (motion.kind != MotionKind::Skip) motion_ = {motion.from, motion.to};
  if (stock_) followStock(motion);
  takeLength();
  if (recorder_)
    recorder_->moved(shifted(motion));
  else if (world_)
    world_->moved(shifted(motion));
  followClearance(motion);
  missEnded(motion);
  checkLength(motion);
  checkHeight(motion);
  if (rangeNow_) last_ = rangeNow_();
  if (motion.kind == MotionKind::Skip && std::exchange(touched_, false)) {
    const Point3 way{motion.to[0] - motion.from[0], motion.to[1] - motion.from[1],
                     motion.to[2] - motion.from[2]};
    heightTouched_.reset();
    if (way.x == 0 && way.y == 0 && world_ && world_->cuttingTool() == nullptr) heightTouched_ = work_().z;
    log_.touched(work_(), way);
  }
  takeEvents();
}

void SimWorld::takeLength() {
  if (world_ && machineNow_ != nullptr && world_->isUnknownTool())
    world_->setLengthInForce(std::max(0.0, machineNow_->toolLength()));
}

void SimWorld::probeSwitched(bool on) {
  if (recorder_)
    recorder_->probeSwitched(on);
  else if (world_)
    world_->probeSwitched(on);
}

void SimWorld::paused(std::string_view text) {
  if (stops_.size() < kMostKept) stops_.emplace_back(text);
}

void SimWorld::recorded(std::string_view file, std::optional<double> value) {
  if (records_.size() < kMostKept) records_.push_back({std::string(file), value, position_()});
}

void SimWorld::callBegins(std::uint32_t program, std::span<const double> locals) {
  protected_.push_back((!protected_.empty() && protected_.back()) ||
                       (callKind_ && callKind_(program, locals) == PathKind::Protected));
  log_.callBegins(program, locals);
  if (recorder_) recorder_->callBegins(program, locals);
  lengths_.push_back(machineNow_ == nullptr ? 0 : machineNow_->toolLength());
}

void SimWorld::callEnded(std::uint32_t program) {
  if (!lengths_.empty()) {
    if (lengths_.back() != 0 && machineNow_ != nullptr && machineNow_->toolLength() == 0 && !lostLength_)
      lostLength_ = {program, lengths_.back()};
    lengths_.pop_back();
  }
  if (!protected_.empty()) protected_.pop_back();
  log_.callEnded(program);
  if (recorder_) recorder_->callEnded(program);
}

// What it measures counts as that of a call.
void SimWorld::touchBegins(std::span<const PlannedTouch> /*touches*/) {
  log_.callBegins(0, {});
}

void SimWorld::touchEnded() {
  log_.callEnded(0);
}

void SimWorld::takeEvents() {
  if (!world_ || world_->events().empty()) return;
  // Places of a program that is not kept are copies of its lines: none is made for nothing.
  const bool wanted =
      std::any_of(world_->events().begin(), world_->events().end(), [&](const ProbeEvent& event) {
        const bool contact = event.outcome == Outcome::Contact;
        return (contact ? contacts_ : events_).size() < kMostKept || (!contact && isTold(event));
      });
  const RunPlace place = wanted ? place_() : RunPlace();
  for (const ProbeEvent& event : world_->events())
    if (!isSame(event)) take(event, place);
  world_->forgetEvents();
}

bool SimWorld::isSame(const ProbeEvent& event) {
  if (event.kind == MotionKind::Skip) return false;
  std::uint64_t& last = told_[static_cast<std::size_t>(event.outcome)].block;
  return std::exchange(last, blocks_()) == blocks_();
}

void SimWorld::take(const ProbeEvent& event, const RunPlace& place) {
  const bool contact = event.outcome == Outcome::Contact;
  std::vector<Kept>& kept = contact ? contacts_ : events_;
  ++(contact ? contactCount_ : eventCount_);
  if (!isMeantToMiss(event)) ++outcomes_[static_cast<std::size_t>(event.outcome)];
  const std::size_t index = kept.size();
  if (kept.size() < kMostKept) kept.push_back({event, place});
  if (contact) checkEdge(event, place);
  // The end of the run says it.
  if (event.outcome == Outcome::NotModelled)
    stop_(event.tool != 0
              ? fmt::format("what tool {} is like is not known; a table [[tool]] with its number, length and "
                            "diameter in the machine's file says it (the probe is `tool` of [probe])",
                            event.tool)
          : event.placeUnknown ? fmt::format("{}, {}", kNowhere, machineNow_->lostWhy())
                               : std::string(kRotary));
  else if (asks_ && (event.outcome == Outcome::Miss || event.outcome == Outcome::SetterMiss) &&
           !isMeantToMiss(event))
    keepMiss({event, place}, index, false);
  else if (asks_ && event.outcome == Outcome::Miss && !event.meant && !isInProtectedCall())
    keepMiss({event, place}, index, true);
  else if (!contact && isTold(event) && !isMeantToMiss(event))
    tell(event, place);
  if (event.outcome != Outcome::OutsideTravel || endedOutside_ || !alarm_) return;
  endedOutside_ = true;
  Position at;
  for (std::size_t i = 0; i < kAxes; ++i)
    at[i] = motion_.from[i] + (motion_.to[i] - motion_.from[i]) * event.share;
  stopAt_(at);
  alarm_(fmt::format("{}{} OVER-TRAVEL", kAxisLetters[event.axis], event.reached > event.limit ? '+' : '-'));
}

bool SimWorld::isProtected() const {
  return isInProtectedCall() || (safe_ && safe_());
}

bool SimWorld::isMeantToMiss(const ProbeEvent& event) const {
  return event.outcome == Outcome::Miss && (event.meant || isProtected());
}

bool SimWorld::isTold(const ProbeEvent& event) const {
  return told_[static_cast<std::size_t>(event.outcome)].number <= kMostTold;
}

void SimWorld::tell(const ProbeEvent& event, const RunPlace& place) {
  Diagnostics one;
  reportEvent(event, place.range, one);
  if (one.empty()) return;
  const bool atStart = event.outcome == Outcome::EarlyContact && event.kind == MotionKind::Skip;
  if (atStart && last_.hasPlace()) one.all().front().note(last_, "the move before it");
  noteEmptyOffset(one.all().front());
  if (event.outcome != Outcome::Miss && event.outcome != Outcome::SetterMiss) noteStart(one.all().front());
  addTold(std::move(one.all().front()), static_cast<std::size_t>(event.outcome), place);
}

void SimWorld::addTold(Diagnostic diagnostic, std::size_t kind, const RunPlace& place) {
  Told& told = told_[kind];
  told.code = diagnostic.code;
  told.severity = diagnostic.severity;
  const std::uint32_t here = ++toldAt_[{kind, place.range.file, place.range.begin}];
  if (here == kMostToldAt + 1)
    session_.diagnostics().report<diag::RunRepeats>(place.range, std::string(told.code), kMostToldAt);
  if (here > kMostToldAt) return;
  if (++told.number > kMostTold) {
    told.next = place.range;
    return;
  }
  // Who wants no trace gets a miss in one line: its place, without the text and the calls.
  const bool miss = kind == static_cast<std::size_t>(Outcome::Miss) ||
                    kind == static_cast<std::size_t>(Outcome::SetterMiss);
  if (miss && !options_.trace && !options_.json && place.range.hasPlace()) {
    const SourceFile& file = session_.sources().file(place.range.file);
    diagnostic.message =
        fmt::format("{}:{}: {}", file.name(), file.place(place.range.begin).line, diagnostic.message);
    diagnostic.range = {};
    diagnostic.notes.clear();
    session_.diagnostics().add(std::move(diagnostic));
    return;
  }
  constexpr std::size_t kMostCalls = 8;
  for (std::size_t i = 0; i < place.calls.size() && i < kMostCalls; ++i)
    diagnostic.note(place.calls[place.calls.size() - 1 - i], "called here");
  session_.diagnostics().add(std::move(diagnostic));
}

void SimWorld::finishPicture() {
  settleMiss();
  tellUnseen();
  tellFar();
  tellToolLengths();
  log_.finish();
  if (!recorder_) return;
  addWarnings();
  addInputs();
  RunFacts facts;
  facts.end = end_();
  facts.subject = subject_;
  facts.end.text = toUtf8Text(facts.end.text);
  facts.callers = callersText(facts.end);
  facts.block = block_ ? block_() : blockNow();
  facts.events = outcomes_;
  facts.usedMisses = usedMisses_;
  facts.faults = faults_;
  facts.warnings = static_cast<std::size_t>(
      std::count_if(session_.diagnostics().all().begin(), session_.diagnostics().all().end(),
                    [](const Diagnostic& one) { return one.severity == Severity::Warning; }));
  if (facts.end.ending == Ending::Running && session_.diagnostics().hasErrors())
    facts.unread = session_.diagnostics().all().back().message;
  recorder_->finish(facts, log_.entries());
}

void SimWorld::addFound(const Measurement& found) {
  log_.callBegins(0, {});
  log_.measured(found);
  log_.callEnded(0);
}

void SimWorld::addList(PictureList list) {
  if (recorder_ && !list.lines.empty()) recorder_->addList(std::move(list));
}

std::uint64_t SimWorld::collisions() const {
  std::uint64_t out = 0;
  for (const Outcome outcome : {Outcome::EarlyContact, Outcome::Overtravel, Outcome::StemCollision,
                                Outcome::BodyCollision, Outcome::RapidIntoPart, Outcome::StartInside})
    out += outcomes_[static_cast<std::size_t>(outcome)];
  return out;
}

std::string SimWorld::measuredTable() const {
  std::string out = measuredText(log_.entries(), log_.leftOut(), decimals_, control_);
  if (stock_) out += sim::stockText(*stock_, stockMargin_);
  return out;
}

void SimWorld::reportRest() {
  finishStock();
  finishPicture();
  for (const Told& told : told_) {
    if (told.number <= kMostTold) continue;
    Diagnostic& rest =
        session_.diagnostics().report<diag::TooManyFindings>(told.next, kMostTold, std::string(told.code));
    rest.severity = std::max(rest.severity, told.severity);
  }
  if (recorder_ && recorder_->isFull())
    session_.diagnostics().report<diag::PictureEnds>({}, PictureRecorder::kMostMoves);
}

std::vector<OutputFile> SimWorld::pictures() const {
  std::vector<OutputFile> out;
  if (stock_ && options_.stockMap)
    out.push_back({"stock-map", stockSvg(*stock_, stockMargin_, options_.program)});
  if (!recorder_) return out;
  if (options_.svg) out.push_back({"svg", pictureSvg(recorder_->picture())});
  if (options_.html) out.push_back({"html", pictureHtml(recorder_->picture())});
  return out;
}

PictureBlock SimWorld::blockNow() const {
  const RunPlace place = place_();
  if (!place.range.hasPlace()) return {};
  const SourceFile& file = session_.sources().file(place.range.file);
  std::string text = session_.sources().textUtf8(place.range);
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return {std::move(text), fmt::format("{}:{}", file.name(), file.place(place.range.begin).line),
          place.program == 0 ? "" : fmt::format("O{:04}", place.program)};
}

} // namespace dotek::sim
