// What a `set` does to coordinates: where it may have moved them, and values that mix those from before it
// with those from after it.
#include "frontend/cycle/Lowering.h"
#include "ir/CycleNames.h"
#include "ir/Dataflow.h"
#include "ir/Match.h"
#include "ir/Walk.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace dotek::frontend::cycle {
namespace {

using Axes = std::array<bool, 3>;

// Axes that the statement sets.
Axes setBy(const ir::CycleStatement& statement) {
  Axes out{};
  if (const auto* call = std::get_if<ir::CallCycle>(&statement.node)) {
    if (call->setting) out = call->setting->axes;
    out[2] = out[2] || call->setsTool;
  }
  return out;
}

// How a value follows a shift of the coordinates along an axis: 1 for a coordinate, 0 for a distance.
struct Weight {
  double now = 0;       // of coordinates that hold
  double old = 0;       // of those from before a `set`
  bool unclear = false; // paths disagree, or it is no sum
};
using Weights = std::array<Weight, 3>;
using Known = std::map<ir::VariableId, Weights>;

bool isSome(double weight) {
  return std::abs(weight) > 1e-9;
}

class Reader {
public:
  explicit Reader(const Known& known) : known_(known) {}

  Weights of(const ir::ExpressionPtr& value) const {
    Weights out;
    if (value == nullptr) return out;
    if (const auto* result = std::get_if<ir::MeasuredResult>(&value->node)) {
      if (result->name == ir::ResultName::PositionX) out[0].now = 1;
      if (result->name == ir::ResultName::PositionY) out[1].now = 1;
      if (result->name == ir::ResultName::PositionZ) out[2].now = 1;
      return out;
    }
    if (const auto* use = std::get_if<ir::VariableUse>(&value->node)) {
      const auto found = known_.find(use->variable);
      return found == known_.end() ? out : found->second;
    }
    if (const auto* one = std::get_if<ir::Unary>(&value->node))
      return one->op == ir::UnaryOp::Negate ? scaled(of(one->operand), -1) : out;
    const auto* both = std::get_if<ir::Binary>(&value->node);
    if (both == nullptr) return out;
    const double* left = ir::constantValue(both->left);
    const double* right = ir::constantValue(both->right);
    switch (both->op) {
    case ir::BinaryOp::Add: return sum(of(both->left), of(both->right), 1);
    case ir::BinaryOp::Subtract: return sum(of(both->left), of(both->right), -1);
    case ir::BinaryOp::Multiply:
      if (right != nullptr) return scaled(of(both->left), *right);
      return left != nullptr ? scaled(of(both->right), *left) : out;
    case ir::BinaryOp::Divide:
      return right != nullptr && *right != 0 ? scaled(of(both->left), 1 / *right) : out;
    case ir::BinaryOp::Modulo:
    case ir::BinaryOp::Direction:
    case ir::BinaryOp::BitAnd:
    case ir::BinaryOp::BitOr:
    case ir::BinaryOp::BitXor:
    case ir::BinaryOp::ValueOr:
    case ir::BinaryOp::RoundedAnd:
    case ir::BinaryOp::RoundedOr:
    case ir::BinaryOp::RoundedXor:
    case ir::BinaryOp::RoundedModulo:
    case ir::BinaryOp::Power:
    case ir::BinaryOp::Bearing: return out;
    }
    return out;
  }

  static Weights sum(Weights a, const Weights& b, double factor) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i].now += factor * b[i].now;
      a[i].old += factor * b[i].old;
      a[i].unclear = a[i].unclear || b[i].unclear;
    }
    return a;
  }
  static Weights scaled(Weights a, double factor) { return sum(Weights{}, a, factor); }

private:
  const Known& known_;
};

// Variables that are a deviation wherever they get a value.
class Deviations {
public:
  explicit Deviations(const std::vector<ir::CycleStatement>& list) {
    std::set<ir::VariableId> others;
    for (const ir::CycleStatement& statement : list)
      if (const auto* assign = std::get_if<ir::Assign>(&statement.node))
        (contains(assign->value) ? variables_ : others).insert(assign->variable);
    for (const ir::VariableId id : others)
      variables_.erase(id);
  }
  bool contains(const ir::ExpressionPtr& value) const {
    if (value == nullptr) return false;
    if (const auto* result = std::get_if<ir::MeasuredResult>(&value->node))
      return result->name == ir::ResultName::ErrorX || result->name == ir::ResultName::ErrorY ||
             result->name == ir::ResultName::ErrorZ || result->name == ir::ResultName::SizeError;
    if (const auto* use = std::get_if<ir::VariableUse>(&value->node))
      return variables_.contains(use->variable);
    if (const auto* one = std::get_if<ir::Unary>(&value->node))
      return (one->op == ir::UnaryOp::Negate || one->op == ir::UnaryOp::Absolute) && contains(one->operand);
    const auto* both = std::get_if<ir::Binary>(&value->node);
    if (both == nullptr) return false;
    const bool left = contains(both->left), right = contains(both->right);
    if (both->op == ir::BinaryOp::Add || both->op == ir::BinaryOp::Subtract) return left && right;
    if (both->op == ir::BinaryOp::Multiply)
      return (left && ir::constantValue(both->right) != nullptr) ||
             (right && ir::constantValue(both->left) != nullptr);
    return both->op == ir::BinaryOp::Divide && left && ir::constantValue(both->right) != nullptr;
  }

private:
  std::set<ir::VariableId> variables_;
};

template <class Visit> void eachComparison(const ir::Condition& condition, const Visit& visit) {
  if (const auto* one = std::get_if<ir::Comparison>(&condition.node)) visit(*one);
  if (const auto* negated = std::get_if<ir::Not>(&condition.node)) eachComparison(*negated->inner, visit);
  if (const auto* both = std::get_if<ir::Junction>(&condition.node)) {
    eachComparison(*both->left, visit);
    eachComparison(*both->right, visit);
  }
}

bool same(const Weight& a, const Weight& b) {
  return a.unclear == b.unclear && !isSome(a.now - b.now) && !isSome(a.old - b.old);
}

bool meet(Known& into, const Known& other) {
  bool changed = false;
  for (const auto& [id, weights] : other) {
    const auto [at, isNew] = into.try_emplace(id, weights);
    changed = changed || isNew;
    for (std::size_t i = 0; !isNew && i < weights.size(); ++i) {
      Weight& mine = at->second[i];
      if (mine.unclear || same(mine, weights[i])) continue;
      // A coordinate that only one of the ways has made old.
      const bool aged = !weights[i].unclear &&
                        !isSome(mine.now + mine.old - weights[i].now - weights[i].old) &&
                        (!isSome(mine.now) || !isSome(weights[i].now));
      const Weight joined = aged ? Weight{0, mine.now + mine.old, false} : Weight{0, 0, true};
      if (same(mine, joined)) continue;
      mine = joined;
      changed = true;
    }
  }
  return changed;
}

// Variables that a coordinate may reach: of the others nothing has to be known.
std::vector<bool> followed(const ir::Cycle& cycle, const std::map<ir::VariableId, ir::Axis>& places) {
  std::vector<std::vector<ir::VariableId>> into(cycle.variables.size()); // that are assigned from it
  std::vector<bool> out(cycle.variables.size());
  std::vector<ir::VariableId> open;
  const auto add = [&](ir::VariableId id) {
    if (id >= out.size() || out[id]) return;
    out[id] = true;
    open.push_back(id);
  };
  for (const ir::CycleStatement& statement : cycle.body) {
    const auto* assign = std::get_if<ir::Assign>(&statement.node);
    if (assign == nullptr) continue;
    if (places.contains(assign->variable)) add(assign->variable);
    if (assign->value == nullptr) continue;
    ir::eachNode(assign->value, [&](const ir::Expression& node) {
      if (std::holds_alternative<ir::MeasuredResult>(node.node)) add(assign->variable);
      const auto* use = std::get_if<ir::VariableUse>(&node.node);
      if (use != nullptr && use->variable < into.size()) into[use->variable].push_back(assign->variable);
    });
  }
  while (!open.empty()) {
    const ir::VariableId id = open.back();
    open.pop_back();
    for (const ir::VariableId next : into[id])
      add(next);
  }
  return out;
}

} // namespace

std::vector<std::array<bool, 3>> Lowering::shiftedBefore(const std::vector<ir::CycleStatement>& list) const {
  const auto facts = ir::factsBefore(
      list, Axes{},
      [&](std::size_t at, std::size_t, Axes fact) {
        const Axes set = setBy(list[at]);
        for (std::size_t i = 0; i < fact.size(); ++i)
          fact[i] = fact[i] || set[i];
        return fact;
      },
      [](Axes& into, const Axes& other) {
        const Axes before = into;
        for (std::size_t i = 0; i < into.size(); ++i)
          into[i] = into[i] || other[i];
        return into != before;
      });
  std::vector<Axes> out;
  for (const auto& fact : facts)
    out.push_back(fact.value_or(Axes{}));
  return out;
}

namespace {

// The axis along which a value is one coordinate, and along no other; nothing: it is a length, or no such
// sum.
std::optional<std::size_t> axisOf(const Weights& weights) {
  std::optional<std::size_t> out;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double all = weights[i].now + weights[i].old;
    if (weights[i].unclear) return std::nullopt;
    if (!isSome(all)) continue;
    if (out || isSome(all - 1)) return std::nullopt;
    out = i;
  }
  return out;
}

} // namespace

void Lowering::warnDeviations() {
  const Deviations deviations(cycle_.body);
  for (const ir::CycleStatement& statement : cycle_.body) {
    const auto* call = std::get_if<ir::CallCycle>(&statement.node);
    if (call == nullptr || statement.origin.block != 0) continue;
    site_ = statement.origin.place;
    const auto warn = [&](std::string what, const char* takes, std::string repair) {
      report(makeDiagnostic<diag::DeviationSet>(statement.origin.range(), std::move(what), takes,
                                                std::move(repair)));
    };
    for (const ir::CycleArgument& one : call->arguments) {
      if (!deviations.contains(one.value)) continue;
      const std::string axis(1, one.parameter.back());
      if (one.parameter.starts_with("measured "))
        warn(axis, "coordinate", fmt::format("`NAME.at becomes {} ..`", axis));
      else if (one.parameter == ir::toolPartText(ir::ToolPart::Length) ||
               one.parameter == ir::toolPartText(ir::ToolPart::Radius))
        warn("the " + one.parameter + " of a tool", "length",
             fmt::format("`T.{0} + NAME.error`, or set `{0}_wear`", one.parameter));
    }
  }
  site_ = 0;
}

void Lowering::warnMixed() {
  constexpr std::size_t kMostWork = 4'000'000; // statements times variables
  const std::vector<ir::CycleStatement>& list = cycle_.body;
  bool sets = false;
  for (const ir::CycleStatement& statement : list)
    sets = sets || setBy(statement) != Axes{};
  if (!sets) return;
  const std::vector<bool> follows = followed(cycle_, places_);
  const auto variables = static_cast<std::size_t>(std::count(follows.begin(), follows.end(), true));
  if (list.size() * variables > kMostWork) return;
  const auto after = [&](std::size_t at, std::size_t, Known fact) {
    if (const auto* assign = std::get_if<ir::Assign>(&list[at].node);
        assign != nullptr && follows[assign->variable]) {
      Weights weights = Reader(fact).of(assign->value);
      if (const auto place = places_.find(assign->variable); place != places_.end())
        weights[ir::indexOf(place->second)] = {1, 0, false};
      fact[assign->variable] = weights;
    }
    const Axes set = setBy(list[at]);
    for (auto& [id, weights] : fact)
      for (std::size_t i = 0; i < set.size(); ++i)
        if (set[i]) weights[i] = {0, weights[i].now + weights[i].old, weights[i].unclear};
    return fact;
  };
  const auto facts = ir::factsBefore(list, Known{}, after, meet);
  for (std::size_t at = 0; at < list.size(); ++at) {
    if (!facts[at]) continue;
    const ir::CycleStatement& statement = list[at];
    if (statement.origin.block != 0) continue; // to the start, which is a place
    const Reader reader(*facts[at]);
    site_ = statement.origin.place;
    const auto warn = [&](std::size_t i, const char* what, const char* how) {
      report(makeDiagnostic<diag::CoordinatesMixed>(statement.origin.range(), what, std::string(1, "xyz"[i]),
                                                    how));
    };
    const auto mixed = [&](const Weights& weights) {
      for (std::size_t i = 0; i < weights.size(); ++i)
        if (!weights[i].unclear && isSome(weights[i].now) && isSome(weights[i].old)) {
          warn(i, "a coordinate", "meets one from after it");
          return;
        }
    };
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* both = std::get_if<ir::Binary>(&node.node);
      if (both == nullptr) return;
      if (both->op == ir::BinaryOp::Add) mixed(Reader::sum(reader.of(both->left), reader.of(both->right), 1));
      if (both->op == ir::BinaryOp::Subtract)
        mixed(Reader::sum(reader.of(both->left), reader.of(both->right), -1));
    });
    if (const ir::ConditionPtr* condition = ir::conditionOf(statement);
        condition != nullptr && *condition != nullptr)
      eachComparison(**condition, [&](const ir::Comparison& one) {
        mixed(Reader::sum(reader.of(one.left), reader.of(one.right), -1));
      });
    const auto coordinate = [&](const ir::ExpressionPtr& value, std::size_t i) {
      const Weights weights = reader.of(value);
      const Weight& weight = weights[i];
      if (!weight.unclear && isSome(weight.old) && !isSome(weight.now))
        warn(i, "a coordinate", "is used as one after it");
      if (const auto along = axisOf(weights); along && *along != i)
        report(makeDiagnostic<diag::AxisCrossed>(statement.origin.range(), std::string(1, "xyz"[*along]),
                                                 std::string(1, "xyz"[i])));
    };
    const auto target = [&](const std::optional<ir::Coordinate>& one, std::size_t i) {
      if (one && one->frame == ir::Frame::Work && one->system == nullptr) coordinate(one->value, i);
    };
    if (const auto* move = std::get_if<ir::Move>(&statement.node))
      for (std::size_t i = 0; i < 3; ++i)
        target(move->axes[i], i);
    if (const auto* measure = std::get_if<ir::Measure>(&statement.node))
      target(measure->target, ir::indexOf(measure->axis));
    if (const auto* call = std::get_if<ir::CallCycle>(&statement.node))
      for (const ir::CycleArgument& one : call->arguments)
        if (one.frame == ir::Frame::Work || one.parameter.starts_with("measured "))
          if (const char axis = one.parameter.back(); axis >= 'x' && axis <= 'z')
            coordinate(one.value, static_cast<std::size_t>(axis - 'x'));
  }
  site_ = 0;
}

} // namespace dotek::frontend::cycle
