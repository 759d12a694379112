// What a program of a control says with its own means, and the language with a word: waits, checks of the
// control's state, the place of the probe, writes of work offsets.
#include "backends/cycle/Idioms.h"
#include "backends/common/Waits.h"
#include "backends/cycle/Jumps.h"
#include "ir/CycleNames.h"
#include "ir/Evaluate.h"
#include "ir/InferKinds.h"
#include "ir/Match.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "stdlib/Control.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <utility>

namespace dotek::backends::cycle {

namespace {

constexpr double kFirstSystem = 54, kLastSystem = 59;
constexpr int kModalGroups = 130; // #4000 to #4130

// ATAN[Y]/[X] that gives 0 to 360, of which the language has -180 to 180 alone.
void nameBearings(State& state) {
  std::vector<ir::CycleStatement> out;
  for (ir::CycleStatement& one : state.cycle.body) {
    std::vector<ir::CycleStatement> before;
    ir::rewrite(one, [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
      const auto* bearing = std::get_if<ir::Binary>(&node->node);
      if (bearing == nullptr || bearing->op != ir::BinaryOp::Bearing) return node;
      ir::Variable made;
      made.name = "bearing";
      made.kind = ir::Kind::Angle;
      made.range = one.origin.range();
      const ir::VariableId id = state.cycle.add(std::move(made));
      const ir::ExpressionPtr use = ir::variable(id);
      const ir::LabelId label = state.cycle.addLabel({"bearing_fine", {}});
      const auto add = [&](auto what) { before.push_back(ir::CycleStatement{std::move(what), one.origin}); };
      add(ir::Assign{id, ir::binary(ir::BinaryOp::Direction, bearing->left, bearing->right)});
      add(ir::Branch{ir::compare(ir::Relation::GreaterEqual, use, ir::constant(0)), label});
      add(ir::Assign{id, ir::binary(ir::BinaryOp::Add, use, ir::constant(360))});
      add(ir::Label{label});
      return use;
    });
    std::move(before.begin(), before.end(), std::back_inserter(out));
    out.push_back(std::move(one));
  }
  state.cycle.body = std::move(out);
}

// The variable, or the one that its computed number counts from.
std::optional<std::uint32_t> numberOf(const ir::ExpressionPtr& number) {
  if (const double* value = ir::constantValue(number))
    return *value >= 0 && *value < 1e8 ? std::optional(static_cast<std::uint32_t>(*value)) : std::nullopt;
  return ir::firstNumber(number);
}

class Idioms {
public:
  Idioms(State& state, const stdlib::Control& control)
      : state_(state), list_(state.cycle.body), variables_(control.variables), control_(control) {
    const auto* code = control.find(stdlib::Function::WorkSystem);
    if (code != nullptr && code->group && variables_.modalFirst)
      inForce_ = *variables_.modalFirst + *code->group;
  }

  void run() {
    dropWaits();
    dropDemands();
    findPlaces();
  }
  void offsets() {
    for (ir::CycleStatement& one : list_)
      if (const auto* store = std::get_if<ir::Store>(&one.node))
        if (auto set = setting(*store)) one.node = std::move(*set);
    joinSettings();
  }

private:
  // ---- G53 without an axis: the control ends what it has read ahead

  void dropWaits() {
    std::erase_if(list_, [&](const ir::CycleStatement& one) {
      const auto* block = std::get_if<ir::OpaqueBlock>(&one.node);
      if (block == nullptr || !isWait(*block, control_)) return false;
      state_.note(one.origin.range(), "a wait for the blocks before it",
                  "a cycle reads a value when it gets there; each target waits where it has to");
      return true;
    });
  }

  // ---- checks of modes and shifts

  struct Reads {
    bool modes = false, machine = false, offsets = false, other = false;
  };

  bool isAt(std::uint32_t number, const std::optional<int>& first, int count) const {
    return first && number >= static_cast<std::uint32_t>(*first) &&
           number < static_cast<std::uint32_t>(*first + count);
  }

  Reads readsOf(const ir::CycleStatement& statement) const {
    Reads out;
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const bool reads = std::holds_alternative<ir::VariableUse>(node.node) ||
                         std::holds_alternative<ir::MeasuredResult>(node.node);
      out.other = out.other || reads;
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      if (variable == nullptr) return;
      const auto number = numberOf(variable->number);
      const int step = std::max(variables_.systemStep, 1) * 6;
      if (!number)
        out.other = true;
      else if (isAt(*number, variables_.modalFirst, kModalGroups + 1))
        out.modes = true;
      else if (isAt(*number, variables_.workOffsetX, std::max(step, 3 * variables_.axisStep)) ||
               isAt(*number, variables_.externalX, 2 * variables_.axisStep + 1))
        out.offsets = true;
      else if (isAt(*number, variables_.machine, 3))
        out.machine = true;
      else if (!isAt(*number, variables_.position, 3) && !isAt(*number, variables_.toolLength, 3))
        out.other = true;
    });
    return out;
  }

  // IF[#4006 NE 21] #3000=..: what a target demands of its caller is written anew for each.
  void dropDemands() {
    std::vector<ir::CycleStatement> kept;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      const auto* branch = std::get_if<ir::Branch>(&list_[i].node);
      const auto* alarm = i + 1 < list_.size() ? std::get_if<ir::Alarm>(&list_[i + 1].node) : nullptr;
      const auto* label = i + 2 < list_.size() ? std::get_if<ir::Label>(&list_[i + 2].node) : nullptr;
      if (branch != nullptr && alarm != nullptr && label != nullptr && label->label == branch->target) {
        const Reads reads = readsOf(list_[i]);
        const bool state = reads.modes || (reads.machine && reads.offsets);
        if (state && !reads.other) {
          state_.note(list_[i].origin.range(),
                      fmt::format("the check `{}` of the control's state", alarm->message),
                      "each target demands of its caller what it needs, with an alarm of its own");
          ++i;
          continue;
        }
      }
      kept.push_back(std::move(list_[i]));
    }
    list_ = std::move(kept);
  }

  // ---- #5001: where the probe is

  ir::VariableId host(const std::string& name) {
    for (ir::VariableId id = 0; id < state_.cycle.variables.size(); ++id)
      if (state_.cycle.variable(id).role == ir::Role::Host && state_.cycle.variable(id).name == name)
        return id;
    ir::Variable made;
    made.name = name;
    made.kind = ir::Kind::Length;
    made.role = ir::Role::Host;
    made.range = state_.cycle.range;
    return state_.cycle.add(std::move(made));
  }

  static std::optional<ir::Axis> axisOf(const ir::ExpressionPtr& value, const std::optional<int>& first) {
    const auto* variable = std::get_if<ir::MachineVariable>(&bare(value).node);
    const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
    if (number == nullptr || !first) return std::nullopt;
    for (const ir::Axis axis : ir::kAxes)
      if (*number == *first + static_cast<int>(ir::indexOf(axis))) return axis;
    return std::nullopt;
  }

  bool isLength(const ir::ExpressionPtr& value) const {
    const auto* variable = std::get_if<ir::MachineVariable>(&bare(value).node);
    const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
    return number != nullptr && variables_.toolLength &&
           *number == *variables_.toolLength + static_cast<int>(ir::indexOf(ir::Axis::Z));
  }

  void findPlaces() {
    std::array<bool, 3> moved{};
    const std::set<ir::LabelId> loops = loopLabels(list_);
    const bool holdsLength = !control_.withToolLength || control_.withToolLength->position;
    const auto here = [&](ir::Axis axis) {
      const std::size_t i = ir::indexOf(axis);
      return ir::variable(host(fmt::format("{}_{}", moved[i] ? "here" : "start", "xyz"[i])));
    };
    for (ir::CycleStatement& one : list_) {
      ir::rewrite(one, [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
        if (const auto end = axisOf(node, variables_.blockEnd)) return here(*end); // without the length
        const auto axis = axisOf(node, variables_.position);
        if (axis && (*axis != ir::Axis::Z || !holdsLength)) return here(*axis);
        const auto* less = std::get_if<ir::Binary>(&node->node);
        if (holdsLength && less != nullptr && less->op == ir::BinaryOp::Subtract && isLength(less->right) &&
            axisOf(less->left, variables_.position) == ir::Axis::Z)
          return here(ir::Axis::Z);
        return node;
      });
      constexpr std::array<bool, 3> kAll = {true, true, true};
      ir::match(
          one,
          [&](const ir::Move& node) {
            for (std::size_t i = 0; i < moved.size(); ++i)
              moved[i] = moved[i] || node.axes[i];
          },
          [&](const ir::CallCycle& node) {
            // What is set gives other coordinates to the same place.
            if ((node.moves && !node.returns) || node.setting) moved = kAll;
          },
          [&](const ir::Measure& node) {
            if (node.setting) moved = kAll;
          },
          [&](const ir::OpaqueBlock&) { moved = kAll; },
          [&](const ir::Store& node) {
            const auto number = numberOf(node.number);
            if (!number || *number >= 1000) moved = kAll;
          },
          [&](const ir::Label& node) {
            if (loops.contains(node.label)) moved = kAll; // by a run before
          },
          [](const ir::OneOf<ir::Jump, ir::Branch, ir::ProbePower, ir::Comment, ir::Assign, ir::Return,
                             ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm, ir::Port,
                             ir::Print> auto&) {});
    }
  }

  // ---- #[5221+[S-54]*20]=..: a work offset

  struct Number {
    ir::ExpressionPtr system; // G number
    ir::Axis axis = ir::Axis::X;
  };

  std::optional<std::pair<double, ir::Axis>> offsetAt(double number) const {
    if (!variables_.workOffsetX || variables_.systemStep == 0 || variables_.axisStep == 0)
      return std::nullopt;
    for (const ir::Axis axis : ir::kAxes)
      for (double system = kFirstSystem; system <= kLastSystem; ++system)
        if (number == *variables_.workOffsetX + (system - kFirstSystem) * variables_.systemStep +
                          static_cast<double>(ir::indexOf(axis)) * variables_.axisStep)
          return std::pair(system, axis);
    return std::nullopt;
  }

  std::optional<double> at(const ir::ExpressionPtr& number, ir::VariableId id, double value) const {
    ir::Environment environment(state_.cycle.variables.size());
    environment[id] = ir::Scalar::of(value);
    const ir::Scalar out = ir::evaluate(*number, environment);
    return out.known() ? std::optional(out.value) : std::nullopt;
  }

  // The system and axis whose offset has this number, whatever the variable in it is.
  std::optional<Number> offsetNumber(const ir::ExpressionPtr& number) const {
    if (const double* constant = ir::constantValue(number)) {
      const auto found = offsetAt(*constant);
      if (!found) return std::nullopt;
      return Number{ir::constant(found->first), found->second};
    }
    std::set<ir::VariableId> used;
    bool other = false;
    ir::eachNode(number, [&](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) used.insert(use->variable);
      other = other || std::holds_alternative<ir::MachineVariable>(node.node) ||
              std::holds_alternative<ir::MeasuredResult>(node.node);
    });
    if (other || used.size() != 1) return std::nullopt;
    for (const double shift : {0.0, kFirstSystem - 1}) { // the source counts from 54, or from 1
      std::optional<ir::Axis> axis;
      bool fits = true;
      for (double system = kFirstSystem; system <= kLastSystem && fits; ++system) {
        const auto value = at(number, *used.begin(), system - shift);
        const auto found = value ? offsetAt(*value) : std::nullopt;
        fits = found && found->first == system && (!axis || *axis == found->second);
        if (found) axis = found->second;
      }
      if (!fits) continue;
      const ir::ExpressionPtr use = ir::variable(*used.begin());
      return Number{shift == 0 ? use : ir::binary(ir::BinaryOp::Add, use, ir::constant(shift)), *axis};
    }
    return std::nullopt;
  }

  // The offset of the active system along the axis.
  bool isActiveOffset(const ir::ExpressionPtr& value, ir::Axis axis) const {
    const auto* variable = std::get_if<ir::MachineVariable>(&value->node);
    if (variable == nullptr || !inForce_) return false;
    bool reads = false;
    for (double system = kFirstSystem; system <= kLastSystem; ++system) {
      const ir::ExpressionPtr number =
          ir::rewrite(variable->number, [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
            const auto* inner = std::get_if<ir::MachineVariable>(&node->node);
            const double* of = inner == nullptr ? nullptr : ir::constantValue(inner->number);
            if (of == nullptr || *of != *inForce_) return node;
            reads = true;
            return ir::constant(system);
          });
      const ir::Scalar out = ir::evaluate(*number, {});
      const auto found = out.known() ? offsetAt(out.value) : std::nullopt;
      if (!found || found->first != system || found->second != axis) return false;
    }
    return reads;
  }

  struct Term {
    ir::ExpressionPtr value;
    bool minus = false;
  };
  static void terms(const ir::ExpressionPtr& value, bool minus, std::vector<Term>& out) {
    if (const auto* unary = std::get_if<ir::Unary>(&value->node)) {
      if (unary->op == ir::UnaryOp::NullAsZero) return terms(unary->operand, minus, out);
      if (unary->op == ir::UnaryOp::Negate) return terms(unary->operand, !minus, out);
    }
    const auto* binary = std::get_if<ir::Binary>(&value->node);
    if (binary != nullptr && (binary->op == ir::BinaryOp::Add || binary->op == ir::BinaryOp::Subtract)) {
      terms(binary->left, minus, out);
      terms(binary->right, minus != (binary->op == ir::BinaryOp::Subtract), out);
      return;
    }
    out.push_back({value, minus});
  }
  static ir::ExpressionPtr sum(const std::vector<Term>& all) {
    ir::ExpressionPtr out;
    for (const Term& one : all) {
      if (out == nullptr)
        out = one.minus ? ir::unary(ir::UnaryOp::Negate, one.value) : one.value;
      else
        out = ir::binary(one.minus ? ir::BinaryOp::Subtract : ir::BinaryOp::Add, out, one.value);
    }
    return out == nullptr ? ir::constant(0) : out;
  }

  bool isMeasured(const ir::ExpressionPtr& value) const {
    bool out = false;
    ir::eachNode(value, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::VariableUse>(&node.node);
      out = out || std::holds_alternative<ir::MeasuredResult>(node.node) ||
            (use != nullptr && state_.cycle.variable(use->variable).role == ir::Role::Local);
    });
    return out;
  }

  // Offset := active offset + measured - nominal.
  std::optional<ir::CallCycle> setting(const ir::Store& store) const {
    const auto to = offsetNumber(store.number);
    if (!to) return std::nullopt;
    std::vector<Term> all, measured, nominal;
    terms(store.value, false, all);
    const auto active = std::find_if(all.begin(), all.end(), [&](const Term& one) {
      return !one.minus && isActiveOffset(one.value, to->axis);
    });
    if (active == all.end()) return std::nullopt;
    all.erase(active);
    for (const Term& one : all) {
      if (isMeasured(one.value))
        measured.push_back(one);
      else
        nominal.push_back({one.value, !one.minus});
    }
    if (measured.empty()) return std::nullopt;
    ir::CallCycle out;
    out.cycle = std::string(ir::kSetOffset);
    out.moves = false;
    const std::size_t i = ir::indexOf(to->axis);
    out.arguments.push_back(
        {std::string("measured ") + "xyz"[i], sum(measured), std::nullopt, ir::Kind::Length, false});
    out.setting.emplace();
    out.setting->system = to->system;
    out.setting->axes[i] = true;
    out.setting->nominal[i] = sum(nominal);
    return out;
  }

  // One line sets x and y.
  void joinSettings() {
    std::vector<ir::CycleStatement> kept;
    for (ir::CycleStatement& one : list_) {
      auto* next = std::get_if<ir::CallCycle>(&one.node);
      auto* last = kept.empty() ? nullptr : std::get_if<ir::CallCycle>(&kept.back().node);
      const bool both = next != nullptr && last != nullptr && next->cycle == ir::kSetOffset &&
                        last->cycle == ir::kSetOffset &&
                        ir::equal(next->setting->system, last->setting->system);
      bool apart = both;
      for (const ir::Axis axis : ir::kAxes)
        if (both && next->setting->axes[ir::indexOf(axis)] && last->setting->axes[ir::indexOf(axis)])
          apart = false;
      if (!apart) {
        kept.push_back(std::move(one));
        continue;
      }
      for (const ir::Axis axis : ir::kAxes) {
        const std::size_t i = ir::indexOf(axis);
        if (!next->setting->axes[i]) continue;
        last->setting->axes[i] = true;
        last->setting->nominal[i] = next->setting->nominal[i];
      }
      std::move(next->arguments.begin(), next->arguments.end(), std::back_inserter(last->arguments));
      std::move(one.origin.ranges.begin(), one.origin.ranges.end(),
                std::back_inserter(kept.back().origin.ranges));
    }
    list_ = std::move(kept);
  }

  State& state_;
  std::vector<ir::CycleStatement>& list_;
  const stdlib::SystemVariables& variables_;
  const stdlib::Control& control_;
  std::optional<int> inForce_; // variable that holds the active system
};

// What the source keeps in several steps is of the kind of the first value that has one, or of what it is
// compared with.
void keepKinds(State& state) {
  bool again = true;
  const auto take = [&](ir::VariableId id, const ir::ExpressionPtr& from) {
    ir::Variable& variable = state.cycle.variables[id];
    if (variable.role != ir::Role::Local || variable.kind != ir::Kind::Number || isArea(state, from)) return;
    const ir::Kind kind = kindOf(state, from);
    if (kind != ir::Kind::Length && kind != ir::Kind::Angle) return;
    variable.kind = kind;
    again = true;
  };
  const std::function<void(const ir::ConditionPtr&)> compared = [&](const ir::ConditionPtr& condition) {
    if (const auto* inner = std::get_if<ir::Not>(&condition->node)) return compared(inner->inner);
    if (const auto* both = std::get_if<ir::Junction>(&condition->node)) {
      compared(both->left);
      return compared(both->right);
    }
    const auto* comparison = std::get_if<ir::Comparison>(&condition->node);
    if (comparison == nullptr) return;
    for (const auto& [one, other] :
         {std::pair(comparison->left, comparison->right), std::pair(comparison->right, comparison->left)})
      if (const auto* use = std::get_if<ir::VariableUse>(&bare(one).node)) take(use->variable, other);
  };
  while (std::exchange(again, false))
    for (const ir::CycleStatement& one : state.cycle.body) {
      if (const auto* set = std::get_if<ir::Assign>(&one.node)) take(set->variable, set->value);
      if (const ir::ConditionPtr* condition = ir::conditionOf(one)) compared(*condition);
    }
}

} // namespace

void readIdioms(State& state) {
  if (state.options.control == nullptr) return;
  Idioms idioms(state, *state.options.control);
  idioms.run();
  nameCommonVariables(state);
  nameBearings(state);
  idioms.offsets();
  straightenJumps(state);
  ir::inferKinds(state.cycle);
  keepKinds(state);
}

} // namespace dotek::backends::cycle
