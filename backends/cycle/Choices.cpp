// Numbers that a dialog offers under titles: names in the language.
#include "backends/cycle/State.h"
#include "ir/Walk.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends::cycle {

namespace {

constexpr std::size_t kLongest = 24; // characters of a name that reads well

// Whether each use is a comparison for equality with one of the values.
class Uses {
public:
  Uses(const ir::Cycle& cycle, ir::VariableId id, const std::vector<double>& values)
      : id_(id), values_(values) {
    for (const auto* list : {&cycle.checks, &cycle.body})
      for (const ir::CycleStatement& statement : *list) {
        const ir::ConditionPtr* condition = ir::conditionOf(statement);
        if (condition != nullptr) {
          look(*condition);
          continue;
        }
        ir::eachNode(statement, [&](const ir::Expression& node) { refuse(node); });
        const auto* set = std::get_if<ir::Assign>(&statement.node);
        good_ = good_ && (set == nullptr || set->variable != id_);
      }
  }
  bool good() const { return good_; }

private:
  void refuse(const ir::Expression& node) {
    const auto* use = std::get_if<ir::VariableUse>(&node.node);
    good_ = good_ && (use == nullptr || use->variable != id_);
  }
  bool isUse(const ir::ExpressionPtr& value) const {
    const auto* use = std::get_if<ir::VariableUse>(&value->node);
    return use != nullptr && use->variable == id_;
  }
  void look(const ir::ConditionPtr& condition) {
    if (const auto* inner = std::get_if<ir::Not>(&condition->node)) return look(inner->inner);
    if (const auto* both = std::get_if<ir::Junction>(&condition->node)) {
      look(both->left);
      look(both->right);
      return;
    }
    const auto* comparison = std::get_if<ir::Comparison>(&condition->node);
    const bool equality =
        comparison != nullptr &&
        (comparison->relation == ir::Relation::Equal || comparison->relation == ir::Relation::NotEqual ||
         comparison->relation == ir::Relation::Same || comparison->relation == ir::Relation::Different);
    if (equality)
      for (const auto& [one, other] :
           {std::pair(comparison->left, comparison->right), std::pair(comparison->right, comparison->left)}) {
        const double* value = ir::constantValue(other);
        if (isUse(one) && value != nullptr &&
            std::find(values_.begin(), values_.end(), *value) != values_.end())
          return;
      }
    ir::eachNode(condition, [&](const ir::Expression& node) { refuse(node); });
  }

  ir::VariableId id_;
  const std::vector<double>& values_;
  bool good_ = true;
};

} // namespace

void findChoices(State& state) {
  for (const auto& [id, choices] : state.options.choices) {
    ir::Variable& variable = state.cycle.variables[id];
    if (variable.role != ir::Role::Parameter || variable.kind == ir::Kind::WorkOffset || choices.size() < 2)
      continue;
    std::vector<double> values;
    std::vector<std::string> names(choices.size());
    bool counts = true;
    for (const Choice& one : choices) {
      values.push_back(one.value);
      const bool place = one.value >= 1 && one.value <= static_cast<double>(choices.size()) &&
                         one.value == std::floor(one.value);
      counts = counts && place;
      if (!place) continue;
      std::string& name = names[static_cast<std::size_t>(one.value) - 1];
      const std::string proposed = state.options.proposeName(one.title);
      counts = counts && name.empty() && !one.title.empty() && proposed.size() <= kLongest &&
               !state.options.isReserved(proposed);
      name = proposed;
    }
    std::set<std::string> apart(names.begin(), names.end());
    counts = counts && apart.size() == names.size() && !apart.contains("");
    const auto isTitled = [&offered = choices](double value, const char* title) {
      return std::any_of(offered.begin(), offered.end(),
                         [&](const Choice& one) { return one.value == value && one.title == title; });
    };
    const bool flag = choices.size() == 2 && isTitled(0, "no") && isTitled(1, "yes");
    const bool starts = !variable.defaultValue ||
                        std::find(values.begin(), values.end(), *variable.defaultValue) != values.end();
    if ((!counts && !flag) || !starts || !Uses(state.cycle, id, values).good()) continue;
    if (flag)
      variable.kind = ir::Kind::Flag;
    else
      state.choices.emplace(id, std::move(names));
  }
}

} // namespace dotek::backends::cycle
