#include "backends/common/MacroCall.h"

#include "ir/Fold.h"
#include "ir/Linear.h"
#include "ir/Rewrite.h"
#include "stdlib/RefusedLetters.h"
#include "stdlib/SearchTravel.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dotek::backends {

namespace {

constexpr double kBeforeFirstSystem = 53; // SystemCode::Index 1 is G54

ir::ExpressionPtr systemNumber(const stdlib::MacroArgument& argument, const ir::ExpressionPtr& system) {
  if (argument.systemCode == stdlib::SystemCode::GNumber) return system;
  return ir::simplify(
      ir::binary(ir::BinaryOp::Subtract, system, ir::constant(kBeforeFirstSystem), system->range));
}

const ir::CycleArgument* find(const ir::CallCycle& cycle, const std::string& parameter) {
  const auto found =
      std::find_if(cycle.arguments.begin(), cycle.arguments.end(),
                   [&](const ir::CycleArgument& argument) { return argument.parameter == parameter; });
  return found == cycle.arguments.end() ? nullptr : &*found;
}

const stdlib::MacroArgument* placeOf(const stdlib::MacroSignature& signature, const std::string& parameter) {
  const auto found =
      std::find_if(signature.arguments.begin(), signature.arguments.end(),
                   [&](const stdlib::MacroArgument& one) { return stdlib::parameterName(one) == parameter; });
  return found == signature.arguments.end() ? nullptr : &*found;
}

} // namespace

bool isNoTravel(const ir::ExpressionPtr& travel) {
  const ir::ExpressionPtr simple = ir::simplify(travel);
  const double* known = ir::constantValue(simple);
  return known != nullptr && *known == 0;
}

ir::ExpressionPtr longerTravel(const ir::ExpressionPtr& travel, const ir::ExpressionPtr& more) {
  if (isNoTravel(travel)) return travel;
  if (const double* known = ir::constantValue(ir::simplify(travel)))
    return ir::simplify(
        ir::binary(*known < 0 ? ir::BinaryOp::Subtract : ir::BinaryOp::Add, travel, more, travel->range));
  const ir::ExpressionPtr times = ir::binary(
      ir::BinaryOp::Add, ir::constant(1),
      ir::binary(ir::BinaryOp::Divide, more, ir::unary(ir::UnaryOp::Absolute, travel, travel->range)));
  return ir::binary(ir::BinaryOp::Multiply, travel, times, travel->range);
}

ir::ExpressionPtr awayAlong(const ir::CallCycle& cycle, ir::Axis axis) {
  if (cycle.cycle != stdlib::intentName(stdlib::Intent::AngledSurface) || axis == ir::Axis::Z) return nullptr;
  ir::ExpressionPtr angle, distance;
  for (const ir::CycleArgument& one : cycle.arguments) {
    if (one.parameter == stdlib::roleName(stdlib::ArgumentRole::Direction)) angle = one.value;
    if (one.parameter == stdlib::roleName(stdlib::ArgumentRole::Distance)) distance = one.value;
  }
  if (angle == nullptr || distance == nullptr) return nullptr;
  const ir::UnaryOp op = axis == ir::Axis::X ? ir::UnaryOp::Cosine : ir::UnaryOp::Sine;
  return ir::binary(ir::BinaryOp::Multiply, distance, ir::unary(op, angle));
}

ir::ExpressionPtr awayFrom(const ir::ExpressionPtr& position, const ir::CallCycle& cycle, ir::Axis axis) {
  const ir::ExpressionPtr away = position == nullptr ? nullptr : awayAlong(cycle, axis);
  return away == nullptr ? position : ir::binary(ir::BinaryOp::Add, position, away);
}

ir::ExpressionPtr overtravelOf(const stdlib::MacroSet* macros, ir::Axis axis) {
  if (macros == nullptr) return nullptr;
  const auto& facts = macros->probing;
  const auto& known = axis == ir::Axis::Z && facts.overtravelZ ? facts.overtravelZ : facts.overtravel;
  return known ? ir::constant(*known) : nullptr;
}

std::optional<double> searchesOn(const stdlib::MacroSet* source, const stdlib::MacroSet& macros,
                                 const stdlib::MacroSignature& signature, const ir::Measure& measure) {
  if (source == nullptr || source == &macros || !measure.target || measure.target->frame != ir::Frame::Here)
    return std::nullopt;
  const stdlib::MacroSignature* own = signatureOf(*source, measure);
  if (own == nullptr || !stdlib::travelIsSearch(*own, measure.axis) ||
      stdlib::travelIsSearch(signature, measure.axis))
    return std::nullopt;
  const stdlib::ProbingFacts& facts = macros.probing;
  return measure.axis == ir::Axis::Z && facts.overtravelZ ? facts.overtravelZ : facts.overtravel;
}

namespace {

ir::ExpressionPtr beyondOf(const CallValues& values, ir::Axis axis) {
  return values.beyond ? values.beyond(axis) : nullptr;
}

// How far the source searches beyond where it expects the surface; nullptr: not known.
ir::ExpressionPtr searchedBeyond(const ir::CallCycle& cycle, ir::Axis axis, const CallValues& values) {
  const ir::CycleArgument* given =
      find(cycle, std::string(stdlib::roleName(stdlib::ArgumentRole::Overtravel)));
  return given != nullptr ? given->value : beyondOf(values, axis);
}

// Where the surface is expected, of a target that the statement states; nothing: it states none.
std::optional<ir::Frame> targetFrame(const ir::Measure& measure, const stdlib::MacroArgument& /*argument*/) {
  return measure.target ? std::optional(measure.target->frame) : std::nullopt;
}
std::optional<ir::Frame> targetFrame(const ir::CallCycle& cycle, const stdlib::MacroArgument& argument) {
  const ir::CycleArgument* given = find(cycle, stdlib::parameterName(argument));
  return given == nullptr ? std::nullopt : given->frame;
}
std::optional<ir::Frame> targetFrame(const ir::Move& /*move*/, const stdlib::MacroArgument& /*argument*/) {
  return std::nullopt;
}

ir::ExpressionPtr searchedBeyond(const ir::Measure& /*measure*/, ir::Axis axis, const CallValues& values) {
  return beyondOf(values, axis);
}
ir::ExpressionPtr searchedBeyond(const ir::Move& /*move*/, ir::Axis axis, const CallValues& values) {
  return beyondOf(values, axis);
}

// The travel is the macro's whole search, and what the source states leads to the surface alone.
template <class Node>
bool isWholeSearch(const stdlib::MacroSignature& signature, const stdlib::MacroArgument& argument,
                   const Node& node, const CallValues& values) {
  const std::optional<ir::Frame> frame = targetFrame(node, argument);
  return frame && (*frame != ir::Frame::Here || values.travelsToSurface) &&
         stdlib::travelIsSearch(signature, argument);
}

// `to`: the travel to where the surface is expected.
template <class Node>
ir::ExpressionPtr searchOf(const stdlib::MacroSignature& signature, const stdlib::MacroArgument& argument,
                           const Node& node, const CallValues& values, const ir::ExpressionPtr& to) {
  if (to == nullptr || !isWholeSearch(signature, argument, node, values)) return to;
  const ir::ExpressionPtr beyond = searchedBeyond(node, argument.axis, values);
  return beyond == nullptr ? to : longerTravel(to, beyond);
}

ir::ExpressionPtr valueOf(const stdlib::MacroSignature& signature, const stdlib::MacroArgument& argument,
                          const ir::Measure& measure, const CallValues& values) {
  switch (argument.role) {
  case stdlib::ArgumentRole::Target: {
    if (!measure.target) return nullptr;
    return searchOf(signature, argument, measure, values,
                    values.place(*measure.target, argument.axis, argument.frame));
  }
  case stdlib::ArgumentRole::Diameter: return measure.diameter;
  case stdlib::ArgumentRole::Overtravel: return values.overtravel ? values.overtravel() : nullptr;
  case stdlib::ArgumentRole::Nominal:
    return measure.setting ? measure.setting->nominal[ir::indexOf(argument.axis)] : nullptr;
  case stdlib::ArgumentRole::System:
    return measure.setting && values.setsSystem ? systemNumber(argument, measure.setting->system) : nullptr;
  default: return nullptr; // a cycle says nothing of it
  }
}

ir::ExpressionPtr valueOf(const stdlib::MacroSignature& /*signature*/, const stdlib::MacroArgument& argument,
                          const ir::Move& move, const CallValues& values) {
  if (argument.role == stdlib::ArgumentRole::Feed) return move.feed;
  if (argument.role != stdlib::ArgumentRole::Target) return nullptr;
  const auto& coordinate = move.axes[ir::indexOf(argument.axis)];
  return coordinate ? values.place(*coordinate, argument.axis, argument.frame) : nullptr;
}

ir::ExpressionPtr valueOf(const stdlib::MacroSignature& signature, const stdlib::MacroArgument& argument,
                          const ir::CallCycle& cycle, const CallValues& values) {
  if (argument.role == stdlib::ArgumentRole::System)
    return cycle.setting && values.setsSystem ? systemNumber(argument, cycle.setting->system) : nullptr;
  if (argument.role == stdlib::ArgumentRole::Nominal)
    return cycle.setting ? cycle.setting->nominal[ir::indexOf(argument.axis)] : nullptr;
  const ir::CycleArgument* given = find(cycle, stdlib::parameterName(argument));
  if (given == nullptr)
    return argument.role == stdlib::ArgumentRole::Overtravel && values.overtravel ? values.overtravel()
                                                                                  : nullptr;
  if (!given->frame) return given->value;
  return searchOf(
      signature, argument, cycle, values,
      values.place(ir::Coordinate{given->value, *given->frame, nullptr}, argument.axis, argument.frame));
}

// The value with that of each local in its place which one statement alone sets.
ir::ExpressionPtr withLocals(const ir::ExpressionPtr& value, const ir::Cycle* cycle) {
  if (cycle == nullptr) return value;
  return ir::rewrite(value, [&](const ir::ExpressionPtr& node) {
    const auto* use = std::get_if<ir::VariableUse>(&node->node);
    if (use == nullptr || cycle->variable(use->variable).role != ir::Role::Local) return node;
    ir::ExpressionPtr only;
    std::size_t times = 0;
    for (const auto* list : {&cycle->checks, &cycle->body})
      for (const ir::CycleStatement& one : *list)
        if (const auto* assign = std::get_if<ir::Assign>(&one.node);
            assign != nullptr && assign->variable == use->variable) {
          only = assign->value;
          ++times;
        }
    return times == 1 ? only : node;
  });
}

// A field with a minus before it: where its own value is below 0, no control reads the word.
bool isNeverAbove(const ir::ExpressionPtr& value, const ir::Cycle* cycle) {
  const ir::ExpressionPtr simple = ir::simplify(withLocals(value, cycle));
  if (const double* known = ir::constantValue(simple)) return *known <= 0;
  const auto* const unary = std::get_if<ir::Unary>(&simple->node);
  return unary != nullptr && unary->op == ir::UnaryOp::Negate &&
         std::holds_alternative<ir::VariableUse>(unary->operand->node);
}

template <class Node>
MacroCall callOf(const stdlib::MacroSignature& signature, const Node& node, const CallValues& values) {
  MacroCall out;
  out.signature = &signature;
  for (const stdlib::MacroArgument& argument : signature.arguments) {
    const bool search = isWholeSearch(signature, argument, node, values);
    if (search && values.beyond && searchedBeyond(node, argument.axis, values) == nullptr)
      out.endsAtSurface = true;
    ir::ExpressionPtr value = valueOf(signature, argument, node, values);
    out.hasNoWay = out.hasNoWay || (search && value != nullptr && isNoTravel(value));
    if (argument.positive && value != nullptr && isNeverAbove(value, values.cycle)) out.notAbove = &argument;
    if (value != nullptr)
      out.arguments.push_back({&argument, std::move(value)});
    else if (argument.required)
      out.missing.push_back(&argument);
  }
  return out;
}

// What the measurement is about.
ir::ResultName ownResult(const ir::Measure& measure) {
  constexpr ir::ResultName kPositions[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                           ir::ResultName::PositionZ};
  return measure.feature == ir::Feature::Bore ? ir::ResultName::Size : kPositions[ir::indexOf(measure.axis)];
}

} // namespace

const stdlib::MacroSignature* signatureOf(const stdlib::MacroSet& macros, const ir::Measure& measure) {
  return macros.find(measure.feature == ir::Feature::Bore ? stdlib::Intent::Bore : stdlib::Intent::Surface,
                     measure.axis);
}

const stdlib::MacroArgument* macroArgument(const stdlib::MacroSignature& signature,
                                           const std::string& parameter) {
  return placeOf(signature, parameter);
}

const stdlib::MacroSignature* signatureOf(const stdlib::MacroSet& macros, const ir::CallCycle& cycle) {
  const stdlib::MacroSignature* out = nullptr;
  std::ptrdiff_t most = -1;
  for (const stdlib::MacroSignature& one : macros.signatures) {
    if (stdlib::intentName(one.intent) != cycle.cycle || stdlib::axisOf(one) != cycle.axis) continue;
    const bool lacks =
        std::any_of(one.arguments.begin(), one.arguments.end(), [&](const stdlib::MacroArgument& argument) {
          return argument.required && argument.role != stdlib::ArgumentRole::System &&
                 argument.role != stdlib::ArgumentRole::Nominal &&
                 find(cycle, stdlib::parameterName(argument)) == nullptr;
        });
    const auto taken =
        std::count_if(cycle.arguments.begin(), cycle.arguments.end(), [&](const ir::CycleArgument& argument) {
          return placeOf(one, argument.parameter) != nullptr;
        });
    const std::ptrdiff_t worth = lacks ? 0 : taken + 1;
    if (worth <= most) continue;
    most = worth;
    out = &one;
  }
  return out;
}

const stdlib::MacroSignature* signatureOf(const stdlib::MacroSet& macros,
                                          const ir::CycleStatement& statement) {
  if (const auto* measure = std::get_if<ir::Measure>(&statement.node)) return signatureOf(macros, *measure);
  if (const auto* cycle = std::get_if<ir::CallCycle>(&statement.node)) return signatureOf(macros, *cycle);
  return nullptr;
}

std::string featureName(const ir::CallCycle& cycle) {
  std::string out = cycle.cycle;
  std::replace(out.begin(), out.end(), '-', ' ');
  out = (std::string_view("aeiou").find(out.front()) == std::string_view::npos ? "a " : "an ") + out;
  return cycle.axis ? out + " along " + ir::letterOf(*cycle.axis) : out;
}

std::string openMeaning(const stdlib::MacroSignature& signature, const ir::CallCycle& cycle,
                        const stdlib::MacroSet& macros) {
  if (cycle.set == macros.name) return "";
  // What one set leaves open no other is known to do alike, though its own text is known.
  if (!signature.unknown.empty())
    return signature.unknown.starts_with("nothing") ? "more than its letters say" : signature.unknown;
  for (const ir::CycleArgument& given : cycle.arguments) {
    const stdlib::MacroArgument* place = placeOf(signature, given.parameter);
    if (place == nullptr) continue;
    if (!place->unknown.empty()) return place->unknown;
    if (place->role == stdlib::ArgumentRole::Unstated) return "what its " + given.parameter + " says";
  }
  return "";
}

std::string featureName(const ir::Measure& measure) {
  if (measure.feature == ir::Feature::Bore) return "a bore";
  return std::string("a surface along ") + ir::letterOf(measure.axis);
}

std::vector<ir::Axis> measuredAxes(const ir::Measure& measure) {
  if (measure.feature == ir::Feature::Bore) return {ir::Axis::X, ir::Axis::Y};
  return {measure.axis};
}

bool setsAnotherAxis(const ir::Measure& measure) {
  if (!measure.setting) return false;
  const std::vector<ir::Axis> measured = measuredAxes(measure);
  return std::any_of(std::begin(ir::kAxes), std::end(ir::kAxes), [&](ir::Axis axis) {
    return measure.setting->nominal[ir::indexOf(axis)] != nullptr &&
           std::find(measured.begin(), measured.end(), axis) == measured.end();
  });
}

MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::Measure& measure,
                    const CallValues& values) {
  return callOf(signature, measure, values);
}

MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::CallCycle& cycle,
                    const CallValues& values) {
  MacroCall out = callOf(signature, cycle, values);
  const std::string overtravel(stdlib::roleName(stdlib::ArgumentRole::Overtravel));
  const bool inTravel =
      std::any_of(signature.arguments.begin(), signature.arguments.end(),
                  [&](const auto& argument) { return isWholeSearch(signature, argument, cycle, values); });
  for (const ir::CycleArgument& given : cycle.arguments)
    if (placeOf(signature, given.parameter) == nullptr && !(inTravel && given.parameter == overtravel))
      out.notTaken.push_back(given.parameter);
  return out;
}

MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::Move& move, const CallValues& values) {
  return callOf(signature, move, values);
}

std::string refusedSign(const MacroCall& call) {
  if (call.notAbove == nullptr) return "";
  return fmt::format("`{}` of P{} below 0{}", call.notAbove->letter, call.signature->program,
                     call.notAbove->role == stdlib::ArgumentRole::Clearance ? ", which is an island" : "");
}

std::string refusedTogether(const stdlib::MacroSet& macros, const MacroCall& call) {
  std::string letters;
  for (const GivenArgument& one : call.arguments)
    letters += one.argument->letter;
  const auto* rule = stdlib::lettersRefused(macros, call.signature->program, letters);
  if (rule == nullptr) return "";
  std::vector<std::string> shown;
  for (const char letter : rule->letters)
    shown.push_back(std::string("`") + letter + "`");
  return fmt::format("{} of P{} together", fmt::join(shown, " and "), call.signature->program);
}

std::optional<ir::Axis> axisNotTaken(const stdlib::MacroSignature& signature, const ir::Move& move) {
  for (const ir::Axis axis : ir::kAxes)
    if (move.axes[ir::indexOf(axis)] && signature.find(stdlib::ArgumentRole::Target, axis) == nullptr)
      return axis;
  return std::nullopt;
}

const stdlib::MacroResult* findResult(const stdlib::MacroSignature& signature, ir::ResultName name) {
  const auto found = std::find_if(signature.results.begin(), signature.results.end(),
                                  [&](const stdlib::MacroResult& result) { return result.name == name; });
  return found == signature.results.end() ? nullptr : &*found;
}

FoundResult resultAfter(const stdlib::MacroSignature& signature, const ir::Measure& measure,
                        ir::ResultName name) {
  FoundResult out{findResult(signature, name), std::nullopt};
  if (out.result != nullptr || name != ir::ResultName::Main) return out;
  out.result = findResult(signature, ownResult(measure));
  if (out.result != nullptr) out.instead = ownResult(measure);
  return out;
}

FoundResult resultAfter(const stdlib::MacroSignature& signature, const ir::CycleStatement& measured,
                        ir::ResultName name) {
  if (const auto* measure = std::get_if<ir::Measure>(&measured.node))
    return resultAfter(signature, *measure, name);
  return {findResult(signature, name), std::nullopt};
}

bool movesProbe(const ir::CycleStatement& statement) {
  return ir::match(
      statement, [](const ir::OneOf<ir::Move, ir::Measure> auto&) { return true; },
      [](const ir::CallCycle& call) { return call.moves; },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::Assign, ir::ProbePower,
                         ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                         ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return false; });
}

bool callsMacros(const ir::Cycle& cycle) {
  return std::any_of(cycle.body.begin(), cycle.body.end(), [](const ir::CycleStatement& statement) {
    return match(
        statement, [](const ir::OneOf<ir::Measure, ir::CallCycle> auto&) { return true; },
        [](const ir::Move& move) { return move.motion == ir::Motion::Protected; },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Assign, ir::Store, ir::ProbePower,
                           ir::Comment, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                           ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {
          return false;
        });
  });
}

} // namespace dotek::backends
