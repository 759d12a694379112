#include "frontend/gibbs/LowerCases.h"

#include <algorithm>

namespace dotek::frontend::gibbs {
namespace {

// Over jumps downwards.
std::size_t arrival(const Flat& flat, std::size_t step, const std::function<void(std::size_t)>& jump) {
  while (step < flat.steps.size()) {
    const auto* here = std::get_if<FlatJump>(&flat.steps[step].step);
    if (here == nullptr || here->target <= step) break;
    jump(step);
    step = here->target;
  }
  return step;
}

} // namespace

std::optional<Cases::Case> Cases::read(const Flat& flat, std::size_t step) {
  const auto* branch = std::get_if<FlatBranch>(&flat.steps[step].step);
  const auto* comparison =
      branch != nullptr ? std::get_if<ir::Comparison>(&branch->condition->node) : nullptr;
  if (comparison == nullptr) return std::nullopt;
  const bool differs = comparison->relation == ir::Relation::NotEqual;
  if (!differs && comparison->relation != ir::Relation::Equal) return std::nullopt;
  const bool turned = std::holds_alternative<ir::VariableUse>(comparison->right->node);
  const auto* use = std::get_if<ir::VariableUse>(&(turned ? comparison->right : comparison->left)->node);
  const double* value = ir::constantValue(turned ? comparison->left : comparison->right);
  if (use == nullptr || value == nullptr) return std::nullopt;
  return Case{use->variable, *value, differs, differs ? branch->target : step + 1, 0, 0};
}

Cases::Cases(const Flat& flat, const std::vector<bool>& heads) {
  for (std::size_t step = 0; step < flat.steps.size(); ++step) {
    if (auto one = read(flat, step)) {
      bool circle = false;
      one->follower = arrival(flat, one->follower, [&](std::size_t jump) { circle = circle || heads[jump]; });
      if (one->follower > step && !circle) cases_.emplace(step, *one);
    }
  }
  for (auto& [first, begin] : cases_) {
    if (begin.row != 0) continue;
    rows_.emplace_back();
    for (auto at = cases_.find(first);;) {
      at->second.row = rows_.size(); // from 1, until all are in one
      at->second.place = rows_.back().steps.size();
      rows_.back().steps.push_back(at->first);
      const auto next = cases_.find(at->second.follower);
      if (next == cases_.end() || next->second.row != 0 || heads[next->first] ||
          next->second.variable != begin.variable)
        break;
      at = next;
    }
    rows_.back().passed.assign(rows_.back().steps.size() + 1, 0);
  }
  for (auto& [step, one] : cases_) {
    --one.row;
    places_[{one.row, one.value}].push_back(one.place);
  }
  for (auto& [value, places] : places_)
    std::sort(places.begin(), places.end());
}

std::optional<ir::VariableId> Cases::variableAt(std::size_t step) const {
  const auto found = cases_.find(step);
  return found == cases_.end() ? std::nullopt : std::optional(found->second.variable);
}

std::size_t Cases::next(std::size_t step, double value) {
  const Case& here = cases_.at(step);
  Row& row = rows_[here.row];
  std::size_t place = row.steps.size();
  if (const auto found = places_.find({here.row, value}); found != places_.end()) {
    const auto at = std::lower_bound(found->second.begin(), found->second.end(), here.place);
    if (at != found->second.end()) place = *at;
  }
  ++row.passed[here.place];
  --row.passed[place];
  return place < row.steps.size() ? row.steps[place] : cases_.at(row.steps.back()).follower;
}

void Cases::forPassed(const Flat& flat, const std::function<void(std::size_t, bool)>& visit) const {
  for (const Row& row : rows_) {
    int passing = 0;
    for (std::size_t place = 0; place < row.steps.size(); ++place) {
      passing += row.passed[place];
      if (passing == 0) continue;
      const std::size_t step = row.steps[place];
      const bool jumps = cases_.at(step).jumps;
      visit(step, jumps);
      const std::size_t to = jumps ? std::get<FlatBranch>(flat.steps[step].step).target : step + 1;
      arrival(flat, to, [&](std::size_t jump) { visit(jump, true); });
    }
  }
}

} // namespace dotek::frontend::gibbs
