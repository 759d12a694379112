#include "verify/Bounds.h"

#include "ir/Evaluate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace dotek::verify {

namespace {

constexpr std::uint32_t kMaxSteps = 10'000;
constexpr double kHalf = 0.5;

void eachComparison(const ir::Condition& condition, const std::function<void(const ir::Comparison&)>& take) {
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition.node)) take(*comparison);
  if (const auto* inner = std::get_if<ir::Not>(&condition.node)) eachComparison(*inner->inner, take);
  if (const auto* both = std::get_if<ir::Junction>(&condition.node)) {
    eachComparison(*both->left, take);
    eachComparison(*both->right, take);
  }
}

double roundedTo(double value, int decimals) {
  const double unit = std::pow(10.0, decimals);
  return std::round(value * unit) / unit + 0.0;
}

double toHalf(double value, int decimals) {
  const double step = decimals > 0 ? kHalf : 1;
  return std::round(value / step) * step + 0.0;
}

// The same name, whatever the case of its letters.
bool sameName(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char one, unsigned char other) {
    return std::tolower(one) == std::tolower(other);
  });
}

} // namespace

Bounds::Bounds(const ir::Cycle& cycle) {
  cycle_.variables = cycle.variables;
  cycle_.checks = cycle.checks;
  for (std::size_t i = 0; i < cycle_.checks.size(); ++i) {
    const ir::CycleStatement& statement = cycle_.checks[i];
    if (const auto* branch = std::get_if<ir::Branch>(&statement.node))
      eachComparison(*branch->condition, [&](const ir::Comparison& one) {
        comparisons_.push_back({&one, i});
      });
    if (const auto* label = std::get_if<ir::Label>(&statement.node)) {
      if (label->label >= places_.size()) places_.resize(label->label + 1, kNone);
      if (places_[label->label] == kNone) places_[label->label] = i;
    }
  }
}

std::optional<double> Bounds::margin(std::size_t comparison, const Case& drawn) const {
  return walk(comparison, drawn).margin;
}

std::vector<std::optional<double>> Bounds::margins(const Case& drawn) const {
  std::vector<std::optional<double>> out(comparisons_.size());
  walk(kNone, drawn, &out);
  return out;
}

bool Bounds::rejects(const Case& drawn) const {
  return walk(kNone, drawn).alarm;
}

Bounds::Walk Bounds::walk(std::size_t wanted, const Case& drawn,
                          std::vector<std::optional<double>>* seen) const {
  ir::Environment environment(cycle_.variables.size());
  for (std::size_t id = 0; id < environment.size(); ++id) {
    const ir::Variable& variable = cycle_.variables[id];
    if (variable.role == ir::Role::Local) continue;
    const auto& values = variable.role == ir::Role::Host ? drawn.hosts : drawn.values;
    for (const auto& [name, value] : values)
      if (sameName(name, variable.name)) environment[id] = ir::Scalar::of(value);
  }
  const auto marginOf = [&](const ir::Comparison& comparison) -> std::optional<double> {
    const ir::Scalar left = ir::evaluate(*comparison.left, environment);
    const ir::Scalar right = ir::evaluate(*comparison.right, environment);
    if (!left.known() || !right.known()) return std::nullopt;
    return left.value - right.value;
  };
  std::vector<bool> come(seen != nullptr ? cycle_.checks.size() : 0);
  const std::size_t end = wanted == kNone ? kNone : comparisons_[wanted].statement;
  std::size_t at = 0;
  for (std::uint32_t steps = 0; at < cycle_.checks.size() && steps < kMaxSteps; ++steps) {
    const ir::CycleStatement& statement = cycle_.checks[at++];
    if (const auto* assign = std::get_if<ir::Assign>(&statement.node))
      if (assign->variable < environment.size())
        environment[assign->variable] = ir::evaluate(*assign->value, environment);
    if (std::holds_alternative<ir::Alarm>(statement.node)) return {true, std::nullopt};
    if (std::holds_alternative<ir::Return>(statement.node)) return {};
    std::optional<ir::LabelId> target;
    if (const auto* jump = std::get_if<ir::Jump>(&statement.node)) target = jump->target;
    if (const auto* branch = std::get_if<ir::Branch>(&statement.node)) {
      if (at - 1 == end) return {false, marginOf(*comparisons_[wanted].comparison)};
      if (seen != nullptr && !come[at - 1]) {
        come[at - 1] = true;
        auto one = std::lower_bound(
            comparisons_.begin(), comparisons_.end(), at - 1,
            [](const Compared& compared, std::size_t place) { return compared.statement < place; });
        for (; one != comparisons_.end() && one->statement == at - 1; ++one)
          (*seen)[static_cast<std::size_t>(one - comparisons_.begin())] = marginOf(*one->comparison);
      }
      const std::optional<bool> holds = ir::holds(*branch->condition, environment);
      if (!holds) return {};
      if (*holds) target = branch->target;
    }
    if (!target) continue;
    if (*target >= places_.size() || places_[*target] == kNone) return {};
    at = places_[*target];
  }
  return {};
}

std::optional<Case> Bounds::meet(const Bound& bound, const std::vector<DrawField>& fields, Case drawn,
                                 bool roundsRadius) const {
  const std::optional<double> before = margin(bound.comparison, drawn);
  if (!before) return std::nullopt;
  const auto matters = [&](std::map<std::string, double> Case::*member, const std::string& name) {
    Case other = drawn;
    (other.*member)[name] += 1;
    const std::optional<double> changed = margin(bound.comparison, other);
    return !changed || *changed != *before;
  };
  if (!matters(&Case::values, fields[bound.field].name)) return std::nullopt;
  for (const DrawField& field : fields) {
    const auto value = drawn.values.find(field.name);
    if (field.fixed || &field == &fields[bound.field] || value == drawn.values.end()) continue;
    if (matters(&Case::values, field.name)) value->second = toHalf(value->second, field.decimals);
  }
  if (const auto radius = drawn.hosts.find("tool_radius"); roundsRadius && radius != drawn.hosts.end())
    if (matters(&Case::hosts, "tool_radius")) radius->second = std::max(kHalf, toHalf(radius->second, 1));
  const DrawField& field = fields[bound.field];
  double& value = drawn.values.at(field.name);
  // Secants: sides are straight lines but for roots and functions of angles.
  constexpr int kSteps = 12;
  double last = value;
  std::optional<double> lastMargin = margin(bound.comparison, drawn);
  value += 1;
  for (int step = 0; step < kSteps; ++step) {
    const std::optional<double> now = margin(bound.comparison, drawn);
    if (!now || !lastMargin) return std::nullopt;
    if (*now == 0) return drawn;
    if (*now == *lastMargin) return std::nullopt;
    const double next = roundedTo(value - *now * (value - last) / (*now - *lastMargin), field.decimals);
    if (!(std::abs(next) < 1000) || next == value) return std::nullopt;
    last = std::exchange(value, next);
    lastMargin = now;
  }
  return std::nullopt;
}

std::vector<Bound> Bounds::find(const std::vector<DrawField>& fields, const std::vector<Case>& samples,
                                bool roundsRadius, std::uint64_t most) const {
  // For each comparison the samples and fields that can meet it at all: one walk finds those of every
  // comparison.
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> worth(comparisons_.size());
  for (std::size_t field = 0; field < fields.size(); ++field) {
    if (fields[field].fixed) continue;
    for (std::size_t sample = 0; sample < samples.size(); ++sample) {
      if (!samples[sample].values.contains(fields[field].name)) continue;
      const auto before = margins(samples[sample]);
      Case other = samples[sample];
      other.values[fields[field].name] += 1;
      const auto changed = margins(other);
      for (std::size_t i = 0; i < comparisons_.size(); ++i)
        if (before[i] && changed[i] != before[i]) worth[i].emplace_back(field, sample);
    }
  }
  std::vector<Bound> out;
  for (std::size_t comparison = 0; comparison < comparisons_.size(); ++comparison)
    for (const auto& [field, sample] : worth[comparison]) {
      if (out.size() >= most) return out;
      const Bound bound{comparison, field};
      if (!out.empty() && out.back().comparison == comparison && out.back().field == field) continue;
      if (meet(bound, fields, samples[sample], roundsRadius)) out.push_back(bound);
    }
  return out;
}

} // namespace dotek::verify
