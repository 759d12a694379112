#include "backends/mikroprog/TargetCycle.h"

#include "ir/CycleNames.h"
#include "ir/Fold.h"
#include "ir/Substitute.h"
#include "ir/Walk.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::targets {

namespace {

constexpr ir::ResultName kPositions[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                         ir::ResultName::PositionZ};

const ir::CallCycle* callOf(const ir::CycleStatement& statement, std::string_view cycle) {
  const auto* call = std::get_if<ir::CallCycle>(&statement.node);
  return call != nullptr && call->cycle == cycle ? call : nullptr;
}

// The touch along the axis before `at`: a plain one, or one that says how it searches. nullopt: none.
std::optional<std::size_t> touchBefore(const std::vector<ir::CycleStatement>& list, std::size_t at,
                                       ir::Axis axis) {
  while (at-- > 0) {
    if (const auto* measure = std::get_if<ir::Measure>(&list[at].node)) {
      const bool fits = measure->feature == ir::Feature::Surface && measure->axis == axis;
      return fits ? std::optional(at) : std::nullopt;
    }
    if (const ir::CallCycle* call = callOf(list[at], ir::kSurface))
      return call->axis == axis ? std::optional(at) : std::nullopt;
    if (const auto* other = std::get_if<ir::CallCycle>(&list[at].node); other != nullptr && other->moves)
      return std::nullopt;
  }
  return std::nullopt;
}

// The touch that gives the value as it is.
std::optional<std::size_t> touchOf(const std::vector<ir::CycleStatement>& list, std::size_t at,
                                   const ir::ExpressionPtr& value, ir::Axis axis) {
  if (const auto* result = std::get_if<ir::MeasuredResult>(&value->node))
    return result->name == kPositions[ir::indexOf(axis)] ? touchBefore(list, at, axis) : std::nullopt;
  const auto* use = std::get_if<ir::VariableUse>(&value->node);
  if (use == nullptr) return std::nullopt;
  while (at-- > 0) {
    const auto* set = std::get_if<ir::Assign>(&list[at].node);
    if (set != nullptr && set->variable == use->variable) return touchOf(list, at, set->value, axis);
  }
  return std::nullopt;
}

bool same(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return a == nullptr ? b == nullptr : b != nullptr && ir::equal(a, b);
}

// false: the touch sets another system, or this axis, already.
bool takeSetting(ir::CycleStatement& touch, ir::Axis axis, const ir::CycleSetting& given) {
  const std::size_t i = ir::indexOf(axis);
  if (auto* measure = std::get_if<ir::Measure>(&touch.node)) {
    if (!measure->setting) measure->setting = ir::OffsetSetting{given.system, {}};
    if (!same(measure->setting->system, given.system) || measure->setting->nominal[i] != nullptr)
      return false;
    measure->setting->nominal[i] = given.nominal[i];
    return true;
  }
  auto& call = std::get<ir::CallCycle>(touch.node);
  if (!call.setting) call.setting = ir::CycleSetting{given.system, {}, {}};
  if (!same(call.setting->system, given.system) || call.setting->axes[i]) return false;
  call.setting->axes[i] = true;
  call.setting->nominal[i] = given.nominal[i];
  return true;
}

// Variables whose value comes from what was measured, also by way of others. The counter of a loop does not.
std::set<ir::VariableId> measuredVariables(const ir::Cycle& cycle) {
  std::set<ir::VariableId> out;
  for (bool grown = true; grown;) {
    grown = false;
    for (const ir::CycleStatement& statement : cycle.body) {
      const auto* set = std::get_if<ir::Assign>(&statement.node);
      if (set == nullptr || out.contains(set->variable)) continue;
      bool measured = false;
      ir::eachNode(set->value, [&](const ir::Expression& node) {
        const auto* use = std::get_if<ir::VariableUse>(&node.node);
        measured = measured || std::holds_alternative<ir::MeasuredResult>(node.node) ||
                   (use != nullptr && out.contains(use->variable));
      });
      if (measured) grown = out.insert(set->variable).second || grown;
    }
  }
  return out;
}

// The innermost part of it that may have no value, and that comes from what was measured; no place: none.
template <class Test>
SourceRange failsWith(const ir::ExpressionPtr& value, const Test& comesFrom, SourceRange whole) {
  if (!ir::mayFail(value)) return {};
  std::vector<ir::ExpressionPtr> parts;
  if (const auto* one = std::get_if<ir::Unary>(&value->node)) parts = {one->operand};
  if (const auto* both = std::get_if<ir::Binary>(&value->node)) parts = {both->left, both->right};
  for (const ir::ExpressionPtr& part : parts)
    if (const SourceRange inner = failsWith(part, comesFrom, whole); inner.hasPlace()) return inner;
  bool measured = false;
  ir::eachNode(value, [&](const ir::Expression& node) { measured = measured || comesFrom(node); });
  if (!measured) return {};
  return value->range.hasPlace() ? value->range : whole;
}

// What still reads a value that was measured: a decision, else a place.
void refuseMeasured(const ir::Cycle& cycle, Diagnostics& diagnostics) {
  for (const ir::CycleStatement& statement : cycle.body) {
    const auto* set = std::get_if<ir::Assign>(&statement.node);
    if (callOf(statement, ir::kSetTool) != nullptr || (set != nullptr && ir::readTool(*set->value)))
      diagnostics.report<diag::MikroprogCannot>(
          statement.origin.range(), "a tool offset of the control",
          "no function for its table is known; hand in what is read as a parameter, and correct by hand");
  }
  const std::set<ir::VariableId> measured = measuredVariables(cycle);
  if (measured.empty()) return;
  const ir::CycleStatement* place = nullptr;
  const auto comesFrom = [&](const ir::Expression& node) {
    const auto* use = std::get_if<ir::VariableUse>(&node.node);
    return std::holds_alternative<ir::MeasuredResult>(node.node) ||
           (use != nullptr && measured.contains(use->variable));
  };
  for (const ir::CycleStatement& statement : cycle.body) {
    if (const auto* set = std::get_if<ir::Assign>(&statement.node)) {
      // Nothing may read it, but a division stays, as it may be an alarm.
      if (const SourceRange at = failsWith(set->value, comesFrom, statement.origin.range()); at.hasPlace())
        diagnostics.report<diag::MikroprogCannot>(
            at, "a value that is computed from what was measured, and may have none, as a division by 0",
            "the control computes nothing with a contact; have the program that calls it compute that");
      continue;
    }
    bool reads = false;
    ir::eachNode(statement, [&](const ir::Expression& node) { reads = reads || comesFrom(node); });
    if (!reads) continue;
    if (ir::conditionOf(statement) != nullptr) {
      diagnostics.report<diag::FlowRefused>(statement.origin.range(), "what was measured");
      continue;
    }
    if (place == nullptr) place = &statement;
  }
  if (place != nullptr)
    diagnostics.report<diag::MikroprogCannot>(
        place->origin.range(), "a value that is computed from what was measured",
        "the control computes nothing with a contact; touch from places that are known before");
}

// Values that no step needs, also those of a function that not every number has, which folding keeps.
void dropUnneeded(ir::Cycle& cycle) {
  std::set<ir::VariableId> needed;
  const auto take = [&](const ir::Expression& node) {
    const auto* use = std::get_if<ir::VariableUse>(&node.node);
    return use != nullptr && needed.insert(use->variable).second;
  };
  for (bool grown = true; grown;) {
    grown = false;
    for (const auto* list : {&cycle.checks, &cycle.body})
      for (const ir::CycleStatement& statement : *list) {
        const auto* set = std::get_if<ir::Assign>(&statement.node);
        if (set != nullptr && list == &cycle.body && !needed.contains(set->variable)) continue;
        ir::eachNode(statement, [&](const ir::Expression& node) { grown = take(node) || grown; });
      }
  }
  std::erase_if(cycle.body, [&](const ir::CycleStatement& statement) {
    const auto* set = std::get_if<ir::Assign>(&statement.node);
    return set != nullptr && !needed.contains(set->variable);
  });
}

} // namespace

void prepareCycle(project::LoweredCycle& lowered, Diagnostics& diagnostics) {
  ir::Cycle& cycle = lowered.cycle;
  std::vector<ir::CycleStatement> absent;
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    if (variable.role == ir::Role::Parameter && variable.optional && !lowered.fixed.contains(id))
      absent.push_back({ir::Assign{id, ir::nullValue(variable.range)}, {}});
  }
  cycle.checks.insert(cycle.checks.begin(), absent.begin(), absent.end());
  const std::size_t before = cycle.body.size();
  std::erase_if(cycle.body, [](const ir::CycleStatement& one) {
    return callOf(one, ir::kResults) != nullptr || callOf(one, ir::kReport) != nullptr;
  });
  if (cycle.body.size() != before) diagnostics.report<diag::CycleResultsRecorded>(cycle.range, cycle.name);
  for (ir::CycleStatement& statement : cycle.body) {
    auto* move = std::get_if<ir::Move>(&statement.node);
    if (move == nullptr || move->motion != ir::Motion::Protected || move->feed == nullptr) continue;
    const auto* use = std::get_if<ir::VariableUse>(&move->feed->node);
    if (use != nullptr && cycle.variable(use->variable).role == ir::Role::Host) move->feed = nullptr;
  }
}

void joinSettings(ir::Cycle& cycle, Diagnostics& diagnostics) {
  std::vector<ir::CycleStatement>& list = cycle.body;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const ir::CallCycle* call = callOf(list[i], ir::kSetOffset);
    if (call == nullptr || !call->setting) continue;
    const SourceRange range = list[i].origin.range();
    const ir::CycleSetting setting = *call->setting;
    const std::vector<ir::CycleArgument> arguments = call->arguments;
    bool joined = !arguments.empty();
    for (const ir::CycleArgument& one : arguments) {
      const ir::Axis axis = ir::kAxes[static_cast<std::size_t>(one.parameter.back() - 'x')];
      const std::optional<std::size_t> touch = touchOf(list, i, one.value, axis);
      joined = joined && touch && takeSetting(list[*touch], axis, setting);
    }
    if (!joined) {
      diagnostics.report<diag::MikroprogCannot>(
          range, "an offset from a value that is computed",
          "the control sets the datum at a contact, and computes nothing with what was measured");
    }
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(i--));
  }
  dropUnneeded(cycle);
  ir::fold(cycle, {}, {true, 100000}); // what only the settings have read is gone
  refuseMeasured(cycle, diagnostics);
}

} // namespace dotek::targets
