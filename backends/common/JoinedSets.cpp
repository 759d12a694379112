#include "backends/common/JoinedSets.h"

#include "ir/CycleNames.h"
#include "ir/Match.h"
#include "ir/Walk.h"

#include <algorithm>
#include <set>
#include <string>

namespace dotek::backends {

namespace {

using List = std::vector<ir::CycleStatement>;

bool setsAlways(const stdlib::MacroSet& macros, ir::Axis axis) {
  bool there = false;
  for (const stdlib::MacroSignature& one : macros.signatures) {
    if (one.intent != stdlib::Intent::Surface || one.find(stdlib::ArgumentRole::Target, axis) == nullptr)
      continue;
    const stdlib::MacroArgument* const system = one.find(stdlib::ArgumentRole::System);
    if (system == nullptr || !system->required) return false;
    there = true;
  }
  return there;
}

std::size_t readsOf(const List& list, const std::set<ir::VariableId>& variables) {
  std::size_t out = 0;
  for (const ir::CycleStatement& one : list)
    ir::eachNode(one, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::VariableUse>(&node.node);
      if (use != nullptr && variables.contains(use->variable)) ++out;
    });
  return out;
}

bool reads(const ir::ExpressionPtr& value, const std::set<ir::VariableId>& variables) {
  bool out = false;
  if (value != nullptr)
    ir::eachNode(value, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::VariableUse>(&node.node);
      out = out || (use != nullptr && variables.contains(use->variable));
    });
  return out;
}

ir::ResultName positionAlong(ir::Axis axis) {
  return axis == ir::Axis::X   ? ir::ResultName::PositionX
         : axis == ir::Axis::Y ? ir::ResultName::PositionY
                               : ir::ResultName::PositionZ;
}

// What follows one touch, as far as it belongs to it.
struct After {
  std::set<ir::VariableId> found;  // what the touch gives
  std::set<ir::VariableId> places; // where the surface lies, of these
  std::size_t set = 0;             // the place of the `set`
};

// nullopt: no `set` of this axis alone by what the touch has found follows it.
std::optional<After> afterTouch(const List& list, std::size_t at, ir::Axis axis) {
  After out;
  enum class Step : std::uint8_t { Next, Ends, Sets };
  for (std::size_t i = at + 1; i < list.size(); ++i) {
    const Step step = ir::match(
        list[i], [](const ir::OneOf<ir::Comment, ir::ProbePower> auto&) { return Step::Next; },
        [&](const ir::Assign& assign) {
          const auto* result = std::get_if<ir::MeasuredResult>(&assign.value->node);
          if (result == nullptr) return Step::Ends;
          out.found.insert(assign.variable);
          if (result->name == positionAlong(axis)) out.places.insert(assign.variable);
          return Step::Next;
        },
        [&](const ir::CallCycle& call) {
          if (call.cycle != ir::kSetOffset || !call.setting || call.arguments.size() != 1) return Step::Ends;
          const auto* use = std::get_if<ir::VariableUse>(&call.arguments.front().value->node);
          const std::size_t a = ir::indexOf(axis);
          const bool joins = use != nullptr && out.places.contains(use->variable) && call.setting->axes[a] &&
                             !reads(call.setting->nominal[a], out.found) &&
                             !reads(call.setting->system, out.found);
          return joins ? Step::Sets : Step::Ends;
        },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Port, ir::Print, ir::Move,
                           ir::Measure, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                           ir::Stop, ir::Alarm, ir::OpaqueBlock> auto&) { return Step::Ends; });
    if (step == Step::Ends) return std::nullopt;
    if (step == Step::Next) continue;
    out.set = i;
    return out;
  }
  return std::nullopt;
}

} // namespace

ir::Cycle joinSets(const ir::Cycle& given, const stdlib::MacroSet& macros) {
  ir::Cycle out = given;
  List& list = out.body;
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto* const measure = std::get_if<ir::Measure>(&list[i].node);
    if (measure == nullptr || measure->feature != ir::Feature::Surface || measure->setting ||
        !setsAlways(macros, measure->axis))
      continue;
    const std::optional<After> after = afterTouch(list, i, measure->axis);
    if (!after || readsOf(list, after->found) != 1) continue;
    const std::size_t a = ir::indexOf(measure->axis);
    const ir::CycleSetting& set = *std::get<ir::CallCycle>(list[after->set].node).setting;
    measure->setting.emplace();
    measure->setting->system = set.system;
    measure->setting->nominal[a] = set.nominal[a];
    for (std::size_t k = after->set; k > i; --k) {
      const auto* assign = std::get_if<ir::Assign>(&list[k].node);
      if (k == after->set || (assign != nullptr && after->found.contains(assign->variable)))
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
  return out;
}

} // namespace dotek::backends
