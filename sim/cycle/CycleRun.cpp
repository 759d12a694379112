#include "sim/cycle/CycleRun.h"

#include "stdlib/AlarmMeaning.h"

#include <cmath>
#include <fmt/format.h>
#include <unordered_map>
#include <utility>

namespace dotek::sim {
namespace {

constexpr std::uint64_t kStatement = 10; // steps, as of a block

std::unordered_map<ir::LabelId, std::size_t> placesOf(const std::vector<ir::CycleStatement>& list) {
  std::unordered_map<ir::LabelId, std::size_t> out;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (const auto* label = std::get_if<ir::Label>(&list[i].node)) out.try_emplace(label->label, i);
  return out;
}

} // namespace

void CycleInputs::take(const Probe& probe) {
  ballRadius = probe.ballRadius();
  stylusRadius = probe.effectiveRadius - probe.preTravel;
  tipLength = probe.centreLength() + probe.ballRadius();
}

CycleRun::CycleRun(Machine& machine, const ir::Cycle& cycle, CycleInputs inputs, const Limits& limits,
                   bool nominal)
    : machine_(machine), cycle_(cycle), inputs_(std::move(inputs)), nominal_(nominal),
      fuel_(limits.simSteps) {
  inputs_.values.resize(cycle.variables.size());
}

// Where the cycle begins and what its stylus is like follows from the machine, unless the caller gives it.
void CycleRun::fillHosts() {
  const Position& at = machine_.position();
  const std::pair<std::string_view, std::optional<double>> known[] = {
      {"start_x", at[0]},
      {"start_y", at[1]},
      {"start_z", at[2]},
      {"tool_radius", inputs_.ballRadius},
      {"overtravel", inputs_.overtravel},
      {"retract", inputs_.retract},
      {"approach_feed", inputs_.approachFeed},
      {"measuring_feed", inputs_.measuringFeed},
  };
  for (ir::VariableId id = 0; id < cycle_.variables.size(); ++id) {
    ir::Scalar& value = inputs_.values[id];
    if (cycle_.variable(id).role != ir::Role::Host || value.state != ir::Scalar::State::Unknown) continue;
    for (const auto& [name, number] : known)
      if (name == cycle_.variable(id).name && number) value = ir::Scalar::of(*number);
  }
}

void CycleRun::follow(CycleWay& way) {
  way = {std::vector<bool>(cycle_.body.size()), 0};
  way_ = &way;
}

bool CycleRun::runAll() {
  start_ = machine_.machinePosition();
  fillHosts();
  return runList(cycle_.checks) && (returned_ || runList(cycle_.body));
}

void CycleRun::run() {
  if (runAll() && !returned_) machine_.finish();
}

bool CycleRun::runFor(CycleCaller& caller) {
  caller_ = &caller;
  return runAll();
}

bool CycleRun::runList(const std::vector<ir::CycleStatement>& list) {
  const auto places = placesOf(list);
  for (std::size_t at = 0; at < list.size();) {
    at_ = &list[at];
    jump_.reset();
    if (way_ != nullptr && &list == &cycle_.body) {
      constexpr std::uint64_t kPrime = 1099511628211; // FNV
      way_->reached[at] = true;
      way_->turns = (way_->turns ^ (at + 1)) * kPrime;
    }
    if (!spend(kStatement)) return false;
    if (caller_ == nullptr) machine_.countBlock(machine_.frame().line);
    if (!step(list[at]) || !machine_.running()) return false;
    if (returned_) return true;
    if (!jump_) {
      ++at;
      continue;
    }
    const auto place = places.find(*jump_);
    if (place == places.end()) return inconclusive("the jump leads to no statement");
    at = place->second;
  }
  return true;
}

bool CycleRun::spend(std::uint64_t steps) {
  if (fuel_ > steps) {
    fuel_ -= steps;
    return true;
  }
  fuel_ = 0;
  return machine_.overLimit(
      "the cycle goes on for more steps than `--limit sim-steps` allows; a loop may have no end");
}

SourceRange CycleRun::place() const {
  return at_ == nullptr ? cycle_.range : at_->origin.range();
}

std::vector<SourceRange> CycleRun::openCalls() const {
  if (at_ == nullptr || at_->origin.ranges.size() < 2) return {};
  // Beside its own place a statement has those of the calls that it was put in for, the innermost first.
  return {at_->origin.ranges.rbegin(), at_->origin.ranges.rend() - 1};
}

bool CycleRun::inconclusive(std::string why) {
  return caller_ != nullptr ? caller_->refused(why) : machine_.inconclusive(std::move(why));
}

bool CycleRun::alarm(stdlib::MacroAlarm kind) {
  alarmKind_ = kind;
  return caller_ != nullptr ? caller_->alarm(kind) : machine_.raiseUnnumbered(stdlib::macroAlarmText(kind));
}

bool CycleRun::raise(std::string_view text) {
  return caller_ != nullptr ? caller_->refused(text) : machine_.raiseUnnumbered(text);
}

bool CycleRun::step(const ir::CycleStatement& statement) {
  return ir::match(
      statement, [&](const ir::Assign& node) { return assign(node); },
      [&](const ir::Store& node) { return store(node); }, [](const ir::Label&) { return true; },
      [&](const ir::Comment& node) {
        comment_ = node.text;
        return true;
      },
      [&](const ir::Jump& node) {
        jump_ = node.target;
        return true;
      },
      [&](const ir::Branch& node) {
        const std::optional<bool> holds = decide(node.condition);
        if (holds == true) jump_ = node.target;
        return holds.has_value();
      },
      [&](const ir::Return&) {
        returned_ = true;
        return caller_ != nullptr || machine_.finish() || true;
      },
      [&](const ir::Move& node) { return move(node); },
      [&](const ir::Measure& node) { return measure(node); },
      [&](const ir::ProbePower& node) {
        machine_.switchProbe(node.on);
        return true;
      },
      [&](const ir::Spindle& node) {
        std::optional<double> speed;
        if (node.speed && !(speed = number(node.speed))) return false;
        machine_.switchSpindle(node.state == ir::Spindle::State::Off         ? 0
                               : node.state == ir::Spindle::State::Clockwise ? 1
                                                                             : 2,
                               speed);
        return true;
      },
      [&](const ir::Coolant& node) {
        machine_.switchCoolant(node.state == ir::Coolant::State::Flood  ? Machine::Coolant::Flood
                               : node.state == ir::Coolant::State::Mist ? Machine::Coolant::Mist
                                                                        : Machine::Coolant::Off);
        return true;
      },
      [&](const ir::SetMode& node) { return setMode(node); },
      [&](const ir::Dwell& node) {
        const std::optional<double> seconds = number(node.seconds);
        if (!seconds) return false;
        if (*seconds < 0) return inconclusive("a dwell is not below 0");
        machine_.dwellFor(*seconds);
        return true;
      },
      [&](const ir::Stop& node) {
        if (!node.optional) machine_.pause(node.message);
        return true;
      },
      [&](const ir::Alarm& node) { return raise(node.message); },
      [&](const ir::CallCycle& node) { return call(node); },
      // No front end makes one in a cycle that runs by itself.
      [&](const ir::OneOf<ir::Port, ir::Print> auto&) {
        return inconclusive("what is printed through the port cannot be run in a cycle");
      },
      [&](const ir::OpaqueBlock&) {
        return inconclusive("what this block means is not known, so the cycle cannot be run");
      });
}

std::optional<double> CycleRun::number(const ir::ExpressionPtr& expression) {
  const ir::Scalar value = ir::evaluate(*expression, inputs_.values, this);
  switch (value.state) {
  case ir::Scalar::State::Known: return value.value;
  case ir::Scalar::State::Failed:
    // Where a value that was left out is read the cycle is wrong; the others are faults of the values.
    if (value.error == ir::ArithmeticError::NoValue)
      inconclusive("a value that the caller has left out is read");
    else
      raise(ir::describe(value.error));
    break;
  case ir::Scalar::State::Null: inconclusive("a value that the caller has left out is read"); break;
  case ir::Scalar::State::Unknown: inconclusive("a value is read that is not known here"); break;
  }
  return std::nullopt;
}

std::optional<bool> CycleRun::decide(const ir::ConditionPtr& condition) {
  switch (ir::decide(*condition, inputs_.values, this)) {
  case ir::Verdict::True: return true;
  case ir::Verdict::False: return false;
  case ir::Verdict::Unknown: inconclusive("the condition reads a value that is not known here"); break;
  case ir::Verdict::Failed: raise("a condition whose arithmetic has no result"); break;
  }
  return std::nullopt;
}

// A variable may become null.
bool CycleRun::assign(const ir::Assign& node) {
  if (const auto read = ir::readTool(*node.value)) {
    const std::optional<double> tool = number(read->second);
    if (!tool || !hasTool(tool)) return false;
  }
  const ir::Scalar value = ir::evaluate(*node.value, inputs_.values, this);
  if (value.state == ir::Scalar::State::Null) {
    inputs_.values[node.variable] = value;
    return true;
  }
  const std::optional<double> known = number(node.value);
  if (known) inputs_.values[node.variable] = ir::Scalar::of(*known);
  return known.has_value();
}

bool CycleRun::store(const ir::Store& node) {
  const std::optional<double> at = number(node.number), value = at ? number(node.value) : std::nullopt;
  if (!value) return false;
  if (!(*at >= 1 && *at < 1e9) || *at != std::floor(*at))
    return inconclusive("it is no number of a variable");
  return machine_.write(static_cast<std::uint32_t>(*at), *value);
}

// Modal codes of a source are about how it counts; here coordinates say that themselves.
bool CycleRun::setMode(const ir::SetMode& node) {
  if (node.mode != ir::Mode::WorkSystem) return true;
  const auto which = system(node.system);
  return which && machine_.selectSystem(*which);
}

std::optional<Machine::WorkSystem> CycleRun::system(const ir::ExpressionPtr& expression) {
  const std::optional<double> value = number(expression);
  if (!value) return std::nullopt;
  const auto which = machine_.workSystem(*value);
  if (!which) raise(fmt::format("there is no work offset {:g}", *value));
  return which;
}

ir::Scalar CycleRun::result(ir::ResultName name) const {
  const auto found = results_.find(name);
  return found == results_.end() ? ir::Scalar{} : ir::Scalar::of(found->second);
}

ir::Scalar CycleRun::machineVariable(double number) const {
  if (const auto tool = ir::toolOf(number))
    return ir::Scalar::of(toolValue(static_cast<std::uint32_t>(tool->second), tool->first));
  if (!(number >= 1 && number < 1e6) || number != std::floor(number)) return {};
  const double value = machine_.common(static_cast<std::uint32_t>(number));
  if (isUnknown(value) || isFresh(value)) return {};
  return isNull(value) ? ir::Scalar::null() : ir::Scalar::of(value);
}

} // namespace dotek::sim
