// Checks: the source's own, before anything is written.
#include "backends/fusion/State.h"
#include "ir/Expression.h"
#include "ir/Flow.h"
#include "support/messages/Fusion.h"

#include <algorithm>

namespace dotek::backends::fusion {

namespace {

constexpr std::uint32_t kMostSteps = 100000; // of a loop in the checks

class Checks {
public:
  explicit Checks(State& state) : state_(state), list_(state.cycle.checks) {
    for (std::size_t i = 0; i < list_.size(); ++i)
      if (const auto* label = std::get_if<ir::Label>(&list_[i].node)) places_[label->label] = i;
    for (std::size_t i = 0; i < list_.size(); ++i)
      if (const auto target = targetOf(i)) from_[*target].push_back(i);
  }

  void write() {
    if (isNested(0, list_.size()))
      nested(0, list_.size());
    else
      stepwise();
  }

private:
  // Index of the label that the statement may jump to.
  std::optional<std::size_t> targetOf(std::size_t at) const {
    const auto label = ir::targetOf(list_[at]);
    return label ? std::optional(places_.at(*label)) : std::nullopt;
  }

  bool isBranch(std::size_t at) const { return std::holds_alternative<ir::Branch>(list_[at].node); }

  // Where the other arm of the branch at `at` ends: a jump is before its target; nothing: it has none.
  std::optional<std::size_t> elseEnd(std::size_t at, std::size_t end) const {
    const std::size_t target = *targetOf(at);
    if (target < at + 2 || !std::holds_alternative<ir::Jump>(list_[target - 1].node)) return std::nullopt;
    const std::size_t behind = *targetOf(target - 1);
    if (behind <= target || behind > end || (behind == end && end != list_.size())) return std::nullopt;
    return behind;
  }

  // Whether [begin, end) is made of plain statements and ifs; every jump into it comes from the if that the
  // label ends.
  bool isNested(std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i) {
      if (std::holds_alternative<ir::Jump>(list_[i].node)) return false;
      if (!isBranch(i)) continue;
      const std::size_t target = *targetOf(i);
      if (target <= i || target >= end) return false;
      if (const auto behind = elseEnd(i, end); behind && *behind < end) {
        if (from_.at(target).size() != 1 || from_.at(*behind).size() != 1) return false;
        if (!isNested(i + 1, target - 1) || !isNested(target + 1, *behind)) return false;
        i = *behind;
        continue;
      }
      if (from_.at(target).size() != 1 || !isNested(i + 1, target)) return false;
      i = target;
    }
    return true;
  }

  void nested(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!isBranch(i)) {
        plain(list_[i]);
        continue;
      }
      const auto& branch = std::get<ir::Branch>(list_[i].node);
      const ir::Origin& origin = list_[i].origin;
      const std::size_t target = *targetOf(i);
      const auto behind = elseEnd(i, end);
      const bool both = behind && *behind < end;
      guardArithmetic(state_, branch.condition, origin);
      state_.script.open("if (" + conditionText(state_, ir::negate(branch.condition), origin.range()) + ") {",
                         origin);
      nested(i + 1, both ? target - 1 : target);
      if (both) {
        state_.script.close("} else {");
        state_.script.reopen();
        nested(target + 1, *behind);
      }
      state_.script.close();
      i = both ? *behind : target;
    }
  }

  // Assignments and alarms.
  void plain(const ir::CycleStatement& statement) {
    const ir::Origin& origin = statement.origin;
    match(
        statement,
        [&](const ir::Assign& node) {
          guardArithmetic(state_, node.value, origin);
          state_.script.add(state_.name(node.variable) + " = " +
                                valueText(state_, node.value, origin.range()) + ";",
                            origin);
        },
        [&](const ir::Alarm& node) {
          const std::string text = node.message.empty() ? "the values are not allowed" : node.message;
          state_.script.add("error(localize(" + quoted(text) + "));", origin);
          state_.script.add("return;", origin);
        },
        [&](const ir::Comment& node) { state_.script.comment(node.text); }, [](const ir::Label&) {},
        [&](const ir::OneOf<ir::Jump, ir::Branch, ir::Store, ir::Move, ir::Measure, ir::CallCycle,
                            ir::ProbePower, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                            ir::Stop, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {
          state_.refuse<diag::FusionRunTime>(origin.range());
        });
  }

  // Jumps that are no ifs: a switch in a loop, a case for each label.
  void stepwise() {
    state_.script.add("var step = 0;");
    state_.script.add("var steps = 0;");
    state_.script.open("while (step >= 0) {");
    state_.errorIf("++steps > " + std::to_string(kMostSteps), "the checks of the cycle do not end", {});
    state_.script.add("switch (step) {");
    state_.script.open("case 0:");
    for (std::size_t i = 0; i < list_.size(); ++i) {
      const ir::Origin& origin = list_[i].origin;
      if (from_.contains(i)) {
        state_.script.close("case " + std::to_string(i + 1) + ":");
        state_.script.reopen();
      } else if (const auto target = targetOf(i)) {
        const std::string go = "step = " + std::to_string(*target + 1) + ";";
        if (const auto* branch = std::get_if<ir::Branch>(&list_[i].node)) {
          guardArithmetic(state_, branch->condition, origin);
          state_.script.open("if (" + conditionText(state_, branch->condition, origin.range()) + ") {",
                             origin);
          state_.script.add(go, origin);
          state_.script.add("break;", origin);
          state_.script.close();
        } else {
          state_.script.add(go, origin);
          state_.script.add("break;", origin);
        }
      } else {
        plain(list_[i]);
      }
    }
    state_.script.add("step = -1;");
    state_.script.close("}");
    state_.script.close();
  }

  State& state_;
  const std::vector<ir::CycleStatement>& list_;
  std::map<ir::LabelId, std::size_t> places_;
  std::map<std::size_t, std::vector<std::size_t>> from_; // label's index: jumps to it
};

} // namespace

void writeChecks(State& state) {
  // Declared first: a function has one level of names.
  std::set<ir::VariableId> assigned;
  for (const ir::CycleStatement& statement : state.cycle.checks)
    if (const auto* assign = std::get_if<ir::Assign>(&statement.node)) assigned.insert(assign->variable);
  for (const ir::VariableId id : assigned)
    if (state.cycle.variable(id).role == ir::Role::Local) state.script.add("var " + state.name(id) + ";");
  Checks(state).write();
}

} // namespace dotek::backends::fusion
