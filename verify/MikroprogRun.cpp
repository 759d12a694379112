#include "verify/MikroprogRun.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::verify {

namespace {

using Kind = MikroprogStep::Kind;
using Ending = MikroprogRecord::Ending;

bool isFault(sim::Outcome outcome) {
  return outcome != sim::Outcome::Contact && outcome != sim::Outcome::Miss;
}

// The functions of a block and the number after its L; a parameter there leads nowhere that is known.
struct Shape {
  std::vector<std::string> functions;
  std::optional<std::uint64_t> target;
  bool empty = true;
};

Shape shapeOf(const sim::ListedBlock& block, const stdlib::MikroprogControl& control) {
  Shape out;
  out.empty = block.store == nullptr && block.words.empty();
  for (const ir::Word& word : block.words) {
    const double* constant = ir::constantValue(word.value);
    if (constant == nullptr) continue;
    const double number = *constant;
    if (number < 0 || number >= 1e9 || number != std::floor(number)) continue;
    if (word.address == 'L') out.target = static_cast<std::uint64_t>(number);
    if (word.address != 'G' && word.address != 'M') continue;
    const auto* function = control.find(word.address, static_cast<std::uint32_t>(number));
    if (function != nullptr) out.functions.push_back(function->function);
  }
  return out;
}

bool has(const Shape& shape, std::string_view function) {
  return std::find(shape.functions.begin(), shape.functions.end(), function) != shape.functions.end();
}

// Between the machine and the world: keeps the steps, and lies to the machine where it is asked to.
class Watch final : public sim::SkipSignal, public sim::MotionWatcher {
public:
  Watch(sim::MikroprogMachine& machine, sim::World& world, const Interference& interference,
        const std::map<std::uint32_t, Kind>& probeMoves)
      : machine_(machine), world_(world), interference_(interference), probeMoves_(probeMoves),
        length_(world.probe().centreLength() + world.probe().ballRadius()) {}

  double length() const { return length_; }

  std::optional<double> contact(const sim::SkipMove& move) override {
    bool standing = true;
    for (std::size_t i = 0; i < 3; ++i)
      standing = standing && move.machineFrom[i] == move.machineTo[i];
    if (standing) return there(move) ? std::optional(0.0) : std::nullopt;
    aim_ = lowest(move.machineTo);
    asked_ = true;
    if (kind() == Kind::Search) {
      if (interference_.missing == record.searches) return disturb(1), std::nullopt;
    } else if (interference_.obstacle == record.protectedMoves) {
      return disturb(1), std::optional(0.5);
    }
    return world_.contact(move);
  }

  void moved(const sim::MachineMotion& motion) override {
    takeMachineEvents();
    MikroprogStep step;
    step.kind = motion.kind == sim::MotionKind::Rapid ? Kind::Rapid : Kind::Feed;
    if (motion.kind == sim::MotionKind::Skip) {
      step.kind = kind();
      step.aim = asked_ ? aim_ : lowest(motion.to);
      if (asked_) ++(step.kind == Kind::Search ? record.searches : record.protectedMoves);
      asked_ = false;
    } else {
      world_.setLine(motion.line);
      world_.moved(motion);
    }
    step.from = lowest(motion.from);
    step.to = lowest(motion.to);
    step.spindle = machine_.spindle();
    step.coolant = machine_.coolant();
    step.line = machine_.line();
    takeWorldEvents(step);
    record.steps.push_back(std::move(step));
  }

  void finish() {
    takeMachineEvents();
    MikroprogStep none;
    takeWorldEvents(none);
  }

  sim::Point3 lowest(const sim::Position& machine) const {
    return {machine[0], machine[1], machine[2] - length_};
  }
  sim::Point3 lowest(const std::array<double, 3>& machine) const {
    return {machine[0], machine[1], machine[2] - length_};
  }

  MikroprogRecord record;

private:
  // Two G31 in one line there are not: a line is a block.
  Kind kind() const {
    const auto found = probeMoves_.find(machine_.line());
    return found == probeMoves_.end() ? Kind::Protected : found->second;
  }

  // `steps` that belong to it and are still to come.
  void disturb(std::size_t steps) {
    takeMachineEvents();
    record.disturbed = record.steps.size() + steps;
  }

  bool there(const sim::SkipMove& here) {
    const std::size_t number = record.guards++;
    if (interference_.touching == number) {
      disturb(0);
      return true;
    }
    const sim::Point3 centre = world_.centreAt(here.machineFrom);
    return sim::firstContact(world_.part(), world_.probe().ballRadius(), centre, centre).has_value();
  }

  void takeWorldEvents(MikroprogStep& step) {
    const std::vector<sim::ProbeEvent>& all = world_.events();
    for (; worldEvents_ < all.size(); ++worldEvents_) {
      const sim::ProbeEvent& event = all[worldEvents_];
      if (isFault(event.outcome))
        record.events.emplace_back(event, machine_.line());
      else if (event.outcome == sim::Outcome::Contact && step.kind == Kind::Search)
        step.contact = event;
    }
  }

  void takeMachineEvents() {
    const std::vector<sim::MikroprogEvent>& all = machine_.events();
    for (; machineEvents_ < all.size(); ++machineEvents_) {
      const sim::MikroprogEvent& event = all[machineEvents_];
      MikroprogStep step;
      switch (event.kind) {
      case sim::MikroprogEvent::Kind::Contact:
      case sim::MikroprogEvent::Kind::NoContact: continue;
      case sim::MikroprogEvent::Kind::Record: step.kind = Kind::Record; break;
      case sim::MikroprogEvent::Kind::Value: step.kind = Kind::Value; break;
      case sim::MikroprogEvent::Kind::Datum: step.kind = Kind::Datum; break;
      case sim::MikroprogEvent::Kind::Stop: step.kind = Kind::Stop; break;
      }
      step.from = step.to = lowest(event.machine);
      step.zero = {event.machine[0] - event.position[0], event.machine[1] - event.position[1],
                   event.machine[2] - event.position[2] - length_};
      step.value = event.value;
      step.text = event.text;
      step.line = static_cast<std::uint32_t>(event.block); // its N; the stand knows the line
      record.steps.push_back(std::move(step));
    }
  }

  sim::MikroprogMachine& machine_;
  sim::World& world_;
  const Interference& interference_;
  const std::map<std::uint32_t, Kind>& probeMoves_;
  const double length_;
  sim::Point3 aim_;
  bool asked_ = false; // for the G31 that runs: one that leads nowhere asks for nothing
  std::size_t worldEvents_ = 0, machineEvents_ = 0;
};

} // namespace

MikroprogStand::MikroprogStand(const stdlib::MikroprogControl& control, const sim::BlockList& program)
    : control_(control), program_(program) {
  classify();
}

// The tail that the program is in from this block on; None: it goes on, or ends without a word.
MikroprogStand::Tail MikroprogStand::tailAt(std::size_t block) const {
  for (std::size_t steps = 0; block < program_.blocks.size() && steps <= program_.blocks.size(); ++steps) {
    const Shape shape = shapeOf(program_.blocks[block], control_);
    if (shape.empty) {
      ++block;
    } else if (shape.functions.size() == 1 && has(shape, "jump") && shape.target) {
      const auto to = program_.numbers.find(*shape.target);
      if (to == program_.numbers.end()) return Tail::None;
      block = to->second;
    } else if (has(shape, "stop")) {
      const std::string& text = program_.blocks[block].text;
      return text == control_.notFound    ? Tail::NotFound
             : text == control_.collision ? Tail::Collision
                                          : Tail::None;
    } else {
      return Tail::None;
    }
  }
  return Tail::None;
}

// What each G31 is, by the paths that lead on from it.
void MikroprogStand::classify() {
  for (std::size_t i = 0; i < program_.blocks.size(); ++i) {
    const Shape shape = shapeOf(program_.blocks[i], control_);
    if (!has(shape, "probe-move")) continue;
    const auto to = shape.target ? program_.numbers.find(*shape.target) : program_.numbers.end();
    if (to == program_.numbers.end()) {
      if (fault_.empty()) faultLine_ = program_.blocks[i].line, fault_ = "a G31 without a block to go to";
      continue;
    }
    const Tail contact = tailAt(i + 1), nothing = tailAt(to->second);
    if (contact == Tail::Collision && nothing == Tail::None)
      probeMoves_[program_.blocks[i].line] = Kind::Protected;
    else if (contact == Tail::None && nothing == Tail::NotFound)
      probeMoves_[program_.blocks[i].line] = Kind::Search;
    else if (fault_.empty())
      faultLine_ = program_.blocks[i].line, fault_ =
                                                "a G31 that neither guards nor searches: of contact and no "
                                                "contact one has to go on and the other to end in its tail";
  }
}

MikroprogRecord MikroprogStand::run(sim::World& world, const sim::Point3& start, const sim::Point3& zero,
                                    const Interference& interference) const {
  MikroprogRecord out;
  if (!fault_.empty()) {
    out.ending = Ending::Broken;
    out.why = fault_;
    out.endLine = faultLine_;
    return out;
  }
  world.restart(0);
  world.setOn(true);
  sim::MikroprogMachine machine(control_, program_);
  Watch watch(machine, world, interference, probeMoves_);
  machine.setPosition({start.x, start.y, start.z + watch.length()});
  machine.setOffset({zero.x, zero.y, zero.z + watch.length()});
  machine.setSkipSignal(&watch);
  machine.setWatcher(&watch);
  machine.run();
  watch.finish();
  out = std::move(watch.record);
  for (MikroprogStep& step : out.steps) {
    if (step.moves()) continue;
    const auto found = program_.numbers.find(step.line);
    step.line = found == program_.numbers.end() ? 0 : program_.blocks[found->second].line;
  }
  out.start = start;
  out.end = watch.lowest(machine.machinePosition());
  out.endLine = machine.line();
  const std::string last = machine.lastStop();
  if (machine.ending() != sim::MikroprogEnding::ProgramEnd) {
    out.ending = Ending::Broken;
    out.why = machine.why();
  } else if (last == control_.notFound) {
    out.ending = Ending::NotFound;
  } else if (last == control_.collision) {
    out.ending = Ending::Collision;
  }
  return out;
}

std::string whyNotCaught(const MikroprogRecord& record, MikroprogRecord::Ending tail) {
  if (!record.disturbed) return "the program does not come to it";
  for (std::size_t next = *record.disturbed; next < record.steps.size(); ++next) {
    const MikroprogStep& step = record.steps[next];
    if (step.moves()) return fmt::format("the program moves on in line {}", step.line);
    if (step.kind == MikroprogStep::Kind::Datum) return fmt::format("a datum is set in line {}", step.line);
    if (step.kind != MikroprogStep::Kind::Stop) return fmt::format("it is recorded in line {}", step.line);
  }
  if (record.ending == tail) return "";
  switch (record.ending) {
  case Ending::Finished: return "the program ends as if nothing had happened";
  case Ending::NotFound: return "it ends in the tail of a surface that is not found";
  case Ending::Collision: return "it ends in the tail of a contact where none is expected";
  case Ending::Broken: return record.why;
  }
  return "";
}

} // namespace dotek::verify
