#include "verify/Bounds.h"

#include "ir/Evaluate.h"
#include "ir/Walk.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace dotek::verify {

namespace {

constexpr double kMostMet = 100000; // a bound beyond is none that a person types

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
bool sameName(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char one, unsigned char other) {
    return std::tolower(one) == std::tolower(other);
  });
}

std::optional<double> valueOf(const std::map<std::string, double>& values, const std::string& name) {
  auto found = values.find(name);
  if (found == values.end())
    found = std::find_if(values.begin(), values.end(),
                         [&](const auto& one) { return sameName(one.first, name); });
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

} // namespace

Bounds::Bounds(const ir::Cycle& cycle) {
  cycle_.variables = cycle.variables;
  cycle_.checks = cycle.checks;
  std::vector<bool> read(cycle_.variables.size());
  for (const ir::CycleStatement& statement : cycle_.checks) {
    std::vector<ir::VariableId>& fields = reads_.emplace_back();
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::VariableUse>(&node.node);
      if (use == nullptr || use->variable >= read.size()) return;
      read[use->variable] = true;
      if (cycle_.variable(use->variable).role == ir::Role::Parameter &&
          std::find(fields.begin(), fields.end(), use->variable) == fields.end())
        fields.push_back(use->variable);
    });
  }
  for (ir::VariableId id = 0; id < read.size(); ++id)
    if (read[id] && cycle_.variable(id).role != ir::Role::Local) inputs_.push_back(id);
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

std::vector<std::size_t> Bounds::fieldsOf(const std::vector<DrawField>& fields) const {
  std::map<std::string_view, std::size_t> places;
  for (std::size_t field = 0; field < fields.size(); ++field)
    places.emplace(fields[field].name, field);
  std::vector<std::size_t> out(cycle_.variables.size(), kNone);
  for (const ir::VariableId id : inputs_) {
    const ir::Variable& variable = cycle_.variable(id);
    if (variable.role != ir::Role::Parameter) continue;
    auto found = places.find(variable.name);
    if (found == places.end())
      found = std::find_if(places.begin(), places.end(),
                           [&](const auto& one) { return sameName(one.first, variable.name); });
    if (found != places.end()) out[id] = found->second;
  }
  return out;
}

std::optional<double> Bounds::margin(std::size_t comparison, const Case& drawn) const {
  return walk(comparison, drawn).margin;
}

bool Bounds::rejects(const Case& drawn) const {
  return walk(kNone, drawn).alarm;
}

Bounds::Walk Bounds::walk(std::size_t wanted, const Case& drawn, std::vector<std::optional<double>>* seen,
                          Influence* influence) const {
  ir::Environment environment(cycle_.variables.size());
  for (const ir::VariableId id : inputs_) {
    const ir::Variable& variable = cycle_.variable(id);
    const auto value = valueOf(variable.role == ir::Role::Host ? drawn.hosts : drawn.values, variable.name);
    if (value) environment[id] = ir::Scalar::of(*value);
  }
  const auto marginOf = [&](const ir::Comparison& comparison) -> std::optional<double> {
    const ir::Scalar left = ir::evaluate(*comparison.left, environment);
    const ir::Scalar right = ir::evaluate(*comparison.right, environment);
    if (!left.known() || !right.known()) return std::nullopt;
    return left.value - right.value;
  };
  std::vector<bool> ours(influence != nullptr ? environment.size() : 0); // no longer what the case says
  if (influence != nullptr) influence->open.assign(environment.size(), false);
  // Calls `compare` with 1 more of each field that the check reads, one at a time.
  const auto eachMore = [&](std::size_t check, const auto& compare) {
    for (const ir::VariableId id : reads_[check]) {
      const ir::Scalar before = environment[id];
      if (ours[id] || !before.known()) continue;
      environment[id] = ir::Scalar::of(before.value + 1);
      compare(id);
      environment[id] = before;
    }
  };
  const auto influences = [&](std::size_t check, std::size_t comparison) {
    const ir::Comparison& node = *comparisons_[comparison].comparison;
    const std::optional<double> before = marginOf(node);
    eachMore(check, [&](ir::VariableId id) {
      if (marginOf(node) != before) influence->changed.emplace_back(id, comparison);
    });
  };
  std::vector<bool> come(seen != nullptr ? cycle_.checks.size() : 0);
  const std::size_t end = wanted == kNone ? kNone : comparisons_[wanted].statement;
  std::size_t at = 0;
  for (std::uint32_t steps = 0; at < cycle_.checks.size() && steps < kMaxSteps; ++steps) {
    const ir::CycleStatement& statement = cycle_.checks[at++];
    if (const auto* assign = std::get_if<ir::Assign>(&statement.node))
      if (assign->variable < environment.size()) {
        if (influence != nullptr) {
          eachMore(at - 1, [&](ir::VariableId id) { influence->open[id] = true; });
          ours[assign->variable] = true;
        }
        environment[assign->variable] = ir::evaluate(*assign->value, environment);
      }
    if (std::holds_alternative<ir::Alarm>(statement.node)) return {true, std::nullopt};
    if (std::holds_alternative<ir::Return>(statement.node)) return {};
    std::optional<ir::LabelId> target;
    if (const auto* jump = std::get_if<ir::Jump>(&statement.node)) target = jump->target;
    if (const auto* branch = std::get_if<ir::Branch>(&statement.node)) {
      if (at - 1 == end) {
        if (influence != nullptr) influences(end, wanted);
        return {false, marginOf(*comparisons_[wanted].comparison)};
      }
      if (seen != nullptr && !come[at - 1]) {
        come[at - 1] = true;
        auto one = std::lower_bound(
            comparisons_.begin(), comparisons_.end(), at - 1,
            [](const Compared& compared, std::size_t place) { return compared.statement < place; });
        for (; one != comparisons_.end() && one->statement == at - 1; ++one) {
          const auto comparison = static_cast<std::size_t>(one - comparisons_.begin());
          (*seen)[comparison] = marginOf(*one->comparison);
          if (influence != nullptr && (*seen)[comparison]) influences(at - 1, comparison);
        }
      }
      const std::optional<bool> holds = ir::holds(*branch->condition, environment);
      if (influence != nullptr)
        eachMore(at - 1, [&](ir::VariableId id) {
          if (ir::holds(*branch->condition, environment) != holds) influence->open[id] = true;
        });
      if (!holds) return {};
      if (*holds) target = branch->target;
    }
    if (!target) continue;
    if (*target >= places_.size() || places_[*target] == kNone) return {};
    at = places_[*target];
  }
  return {};
}

void Bounds::roundOthers(const Bound& bound, const std::vector<DrawField>& fields, double before,
                         Case& drawn) const {
  const std::vector<std::size_t> places = fieldsOf(fields);
  std::vector<ir::VariableId> variables(fields.size(), static_cast<ir::VariableId>(places.size()));
  for (const ir::VariableId id : inputs_)
    if (places[id] != kNone) variables[places[id]] = id;
  Influence influence;
  std::set<ir::VariableId> changed;
  const auto look = [&] {
    const std::optional<double> margin = walk(bound.comparison, drawn, nullptr, &influence).margin;
    changed.clear();
    for (const auto& [id, comparison] : std::exchange(influence.changed, {}))
      changed.insert(id);
    return margin == before;
  };
  bool asBefore = look();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto value = drawn.values.find(fields[i].name);
    if (fields[i].fixed || i == bound.field || value == drawn.values.end()) continue;
    const ir::VariableId id = variables[i];
    if (asBefore) {
      if (id >= places.size()) continue;
      if (influence.open[id]) {
        const double own = std::exchange(value->second, value->second + 1);
        const bool matters = margin(bound.comparison, drawn) != before;
        value->second = own;
        if (!matters) continue;
      } else if (!changed.contains(id)) {
        continue;
      }
    }
    const double half = toHalf(value->second, fields[i].decimals);
    if (std::exchange(value->second, half) != half && asBefore) asBefore = look();
  }
}

std::optional<Case> Bounds::meet(const Bound& bound, const std::vector<DrawField>& fields, Case drawn,
                                 bool roundsRadius) const {
  const std::optional<double> before = margin(bound.comparison, drawn);
  if (!before) return std::nullopt;
  const auto matters = [&](std::map<std::string, double> Case::*member, const std::string& name) {
    double& value = (drawn.*member)[name];
    const double own = std::exchange(value, value + 1);
    const std::optional<double> changed = margin(bound.comparison, drawn);
    value = own;
    return !changed || *changed != *before;
  };
  if (!matters(&Case::values, fields[bound.field].name)) return std::nullopt;
  roundOthers(bound, fields, *before, drawn);
  if (const auto radius = drawn.hosts.find("tool_radius"); roundsRadius && radius != drawn.hosts.end())
    if (matters(&Case::hosts, "tool_radius")) radius->second = std::max(kHalf, toHalf(radius->second, 1));
  const DrawField& field = fields[bound.field];
  double& value = drawn.values.at(field.name);
  const double own = value;
  // Secants: sides are straight lines but for roots and functions of angles. An ABS has its bound on the side
  // of the other sign, too, where another check may let the value pass.
  const auto meets = [&](double from, double more) {
    constexpr int kSteps = 12;
    double last = value = from;
    std::optional<double> lastMargin = margin(bound.comparison, drawn);
    value += more;
    for (int step = 0; step < kSteps; ++step) {
      const std::optional<double> now = margin(bound.comparison, drawn);
      if (now == 0.0) return true;
      if (!now || !lastMargin || *now == *lastMargin) return false;
      const double next = roundedTo(value - *now * (value - last) / (*now - *lastMargin), field.decimals);
      if (!(std::abs(next) < kMostMet) || next == value) return false;
      last = std::exchange(value, next);
      lastMargin = now;
    }
    return false;
  };
  if (meets(own, 1) || meets(own, -1) || meets(-own, own > 0 ? -1 : 1)) return drawn;
  return std::nullopt;
}

std::array<double, 2> Bounds::beside(const Case& met, const DrawField& field) const {
  const double value = met.values.at(field.name), step = std::pow(10.0, -field.decimals);
  const std::array<double, 2> near = {roundedTo(value - step, field.decimals),
                                      roundedTo(value + step, field.decimals)};
  const auto rejected = [&](double other) {
    Case moved = met;
    moved.values[field.name] = other;
    return rejects(moved);
  };
  if (!rejected(near[0]) || !rejected(near[1])) return near;
  // Whole numbers, even ones, tens, turns of an angle.
  constexpr double kWider[] = {1, 2, 5, 10, 15, 45, 90};
  for (const double wider : kWider) {
    const std::array<double, 2> far = {std::ceil(value) - wider, std::floor(value) + wider};
    if (rejected(far[0]) != rejected(far[1])) return far;
  }
  return near;
}

std::vector<Bound> Bounds::find(const std::vector<DrawField>& fields, const std::vector<Case>& samples,
                                bool roundsRadius, std::uint64_t most) const {
  // For each comparison the fields and samples that can meet it at all: one walk of a sample finds those of
  // every comparison, but for fields that may lead the checks another way.
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> worth(comparisons_.size());
  const std::vector<std::size_t> places = fieldsOf(fields);
  for (std::size_t sample = 0; sample < samples.size(); ++sample) {
    std::vector<std::optional<double>> before(comparisons_.size()), changed;
    Influence influence;
    walk(kNone, samples[sample], &before, &influence);
    const auto wanted = [&](ir::VariableId id) {
      return places[id] != kNone && !fields[places[id]].fixed &&
             samples[sample].values.contains(fields[places[id]].name);
    };
    for (const auto& [id, comparison] : influence.changed)
      if (wanted(id) && !influence.open[id]) worth[comparison].emplace_back(places[id], sample);
    for (const ir::VariableId id : inputs_) {
      if (!influence.open[id] || !wanted(id)) continue;
      Case other = samples[sample];
      other.values[fields[places[id]].name] += 1;
      changed.assign(comparisons_.size(), std::nullopt);
      walk(kNone, other, &changed);
      for (std::size_t i = 0; i < comparisons_.size(); ++i)
        if (before[i] && changed[i] != before[i]) worth[i].emplace_back(places[id], sample);
    }
  }
  for (auto& pairs : worth)
    std::sort(pairs.begin(), pairs.end());
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
