#include "lint/LeastValues.h"

#include "lint/CalledFiles.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dotek::lint {

namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();
constexpr int kDepth = 6;           // of what is bounded by what else
constexpr std::size_t kChecks = 60; // that are looked at: more than a dialog has

// Variables that decide whether there is a message, or the dialog comes again: `wrong` of
// `if wrong > 0 then goto ask`.
std::set<std::string> deciding(const gibbs::Macro& macro) {
  std::set<std::string> out;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    const auto* branch = std::get_if<gibbs::If>(&statement.node);
    if (branch == nullptr || !branch->then) return;
    if (!std::holds_alternative<gibbs::Goto>(branch->then->node) && commandName(*branch->then) != "MESSAGE")
      return;
    for (const gibbs::Comparison& one : branch->condition.comparisons)
      for (const gibbs::ExpressionPtr* side : {&one.left, &one.right})
        if (*side) out.merge(readsOf(**side));
  });
  return out;
}

// What follows a check: an error that is counted, a message, the dialog again.
bool isRejection(const gibbs::Statement& statement, const std::set<std::string>& decide,
                 const std::set<std::string>& compared) {
  if (const auto* set = std::get_if<gibbs::Assignment>(&statement.node)) {
    const std::string name = gibbs::foldCase(set->target.name.text);
    return decide.contains(name) && !compared.contains(name);
  }
  return std::holds_alternative<gibbs::Goto>(statement.node) || commandName(statement) == "MESSAGE";
}

} // namespace

LeastValues::LeastValues(const gibbs::Cycle& cycle, const Project& project) {
  if (!cycle.cycleData || cycle.cycleData->hasErrorNodes) return;
  radii_ = radiusNames(*cycle.cycleData, project);
  std::map<std::string, int> written;
  for (const NameUse& use : namesOf(*cycle.cycleData, project))
    if (use.writes) ++written[use.key];
  for (const gibbs::Line& line : cycle.cycleData->lines) {
    const auto* set = line.statement ? std::get_if<gibbs::Assignment>(&line.statement->node) : nullptr;
    if (set == nullptr || set->target.index) continue;
    const std::string name = gibbs::foldCase(set->target.name.text);
    if (written[name] == 1) computed_.emplace(name, set->value.get());
  }
  const std::set<std::string> decide = deciding(*cycle.cycleData);
  readChecks(*cycle.cycleData, decide, {});
  eachStatement(*cycle.cycleData, [&](const gibbs::Statement& statement) {
    const auto* call = std::get_if<gibbs::CallMacro>(&statement.node);
    if (call == nullptr) return;
    const gibbs::Macro* macro = calledMacro(cycle, *call, project);
    if (macro == nullptr || macro->hasErrorNodes) return;
    const std::map<std::string, Sum> given = argumentsOf(*call, *macro);
    if (!given.empty()) readChecks(*macro, decide, given);
  });
}

std::map<std::string, LeastValues::Sum> LeastValues::argumentsOf(const gibbs::CallMacro& call,
                                                                 const gibbs::Macro& macro) const {
  std::map<std::string, Sum> out;
  std::set<std::string> assigned;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    if (const auto* set = std::get_if<gibbs::Assignment>(&statement.node))
      assigned.insert(gibbs::foldCase(set->target.name.text));
    const auto* takes = std::get_if<gibbs::Args>(&statement.node);
    if (takes == nullptr) return;
    for (std::size_t i = 0; i < std::min(takes->names.size(), call.arguments.size()); ++i)
      if (call.arguments[i])
        out[gibbs::foldCase(takes->names[i].name.text)] = sumOf(*call.arguments[i], kDepth);
  });
  for (const std::string& name : assigned)
    out.erase(name); // it is another value by then
  return out;
}

void LeastValues::readChecks(const gibbs::Macro& macro, const std::set<std::string>& decide,
                             const std::map<std::string, Sum>& given) {
  const auto put = [&](Sum sum) {
    for (const auto& [name, value] : given) {
      const auto found = sum.factors.find(name);
      if (found == sum.factors.end()) continue;
      const double factor = found->second;
      sum.factors.erase(found);
      sum.known = sum.known && value.known;
      sum = without(std::move(sum), value, -factor);
    }
    return sum;
  };
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    const auto* branch = std::get_if<gibbs::If>(&statement.node);
    if (branch == nullptr || !branch->then) return;
    std::set<std::string> compared;
    for (const gibbs::Comparison& one : branch->condition.comparisons)
      for (const gibbs::ExpressionPtr* side : {&one.left, &one.right})
        if (*side) compared.merge(readsOf(**side));
    if (!isRejection(*branch->then, decide, compared)) return;
    // Of several comparisons each alone rejects the value where OR joins them.
    const auto& all = branch->condition.connectives;
    if (std::any_of(all.begin(), all.end(),
                    [](gibbs::Connective one) { return one != gibbs::Connective::Or; }))
      return;
    for (const gibbs::Comparison& one : branch->condition.comparisons) {
      if (!one.nots.empty() || !one.left || !one.right) continue;
      using gibbs::Relation;
      if (one.relation == Relation::Equal || one.relation == Relation::NotEqual || kept_.size() == kChecks)
        continue;
      const bool less = one.relation == Relation::Less || one.relation == Relation::LessEqual;
      Sum left = put(sumOf(*one.left, kDepth)), right = put(sumOf(*one.right, kDepth));
      if (left.known && right.known)
        kept_.push_back(less ? without(std::move(left), right, 1) : without(std::move(right), left, 1));
    }
  });
}

double LeastValues::of(const std::string& variable) const {
  return leastOf(variable, kDepth);
}

LeastValues::Sum LeastValues::without(Sum sum, const Sum& other, double times) {
  for (const auto& [name, factor] : other.factors)
    sum.factors[name] -= times * factor;
  sum.number -= times * other.number;
  std::erase_if(sum.factors, [](const auto& one) { return std::abs(one.second) < 1e-12; });
  return sum;
}

LeastValues::Sum LeastValues::sumOf(const gibbs::Expression& expression, int depth) const {
  const auto times = [](Sum sum, double factor) {
    for (auto& [name, one] : sum.factors)
      one *= factor;
    sum.number *= factor;
    return sum;
  };
  const auto plus = [](Sum one, const Sum& other) {
    one.known = one.known && other.known;
    one.number += other.number;
    for (const auto& [name, factor] : other.factors)
      one.factors[name] += factor;
    return one;
  };
  Sum unknown;
  unknown.known = false;
  if (depth <= 0) return unknown;
  if (const std::optional<double> number = plainNumber(expression)) return {{}, *number, true};
  if (const gibbs::Name* name = plainName(expression)) {
    const std::string key = gibbs::foldCase(name->text);
    // What is computed of other fields is bounded as those are together.
    if (const auto found = computed_.find(key); found != computed_.end()) {
      const Sum inner = sumOf(*found->second, depth - 1);
      if (inner.known) return inner;
    }
    return {{{key, 1}}, 0, true};
  }
  if (const auto* inner = std::get_if<gibbs::Bracketed>(&expression.node))
    return sumOf(*inner->inner, depth - 1);
  if (const auto* sign = std::get_if<gibbs::Unary>(&expression.node))
    return times(sumOf(*sign->operand, depth - 1), sign->op == gibbs::UnaryOperator::Minus ? -1 : 1);
  const auto* both = std::get_if<gibbs::Binary>(&expression.node);
  if (both == nullptr) return unknown;
  const Sum left = sumOf(*both->left, depth - 1), right = sumOf(*both->right, depth - 1);
  switch (both->op) {
  case gibbs::BinaryOperator::Add: return plus(left, right);
  case gibbs::BinaryOperator::Subtract: return plus(left, times(right, -1));
  case gibbs::BinaryOperator::Multiply:
    if (left.known && left.factors.empty()) return times(right, left.number);
    if (right.known && right.factors.empty()) return times(left, right.number);
    return unknown;
  case gibbs::BinaryOperator::Divide:
    return right.known && right.factors.empty() && right.number != 0 ? times(left, 1 / right.number)
                                                                     : unknown;
  }
  return unknown;
}

double LeastValues::least(const Sum& sum, int depth) const {
  if (!sum.known || depth <= 0) return kNone;
  const auto below =
      std::find_if(sum.factors.begin(), sum.factors.end(), [](const auto& one) { return one.second < 0; });
  if (below == sum.factors.end()) {
    double out = sum.number;
    for (const auto& [name, factor] : sum.factors)
      if (factor > 0) out += factor * leastOf(name, depth - 1);
    return out;
  }
  // Less a multiple of what is 0 or more by a check, and takes that variable away.
  double out = kNone;
  for (const Sum& kept : kept_)
    if (const auto same = kept.factors.find(below->first); same != kept.factors.end() && same->second < 0)
      out = std::max(out, least(without(sum, kept, below->second / same->second), depth - 2));
  return out;
}

double LeastValues::leastOf(const std::string& variable, int depth) const {
  if (depth <= 0) return kNone;
  double out = radii_.contains(variable) ? 0 : kNone;
  if (const auto found = computed_.find(variable); found != computed_.end())
    out = std::max(out, least(sumOf(*found->second, depth - 1), depth - 1));
  for (const Sum& kept : kept_)
    if (const auto same = kept.factors.find(variable); same != kept.factors.end() && same->second > 0)
      out = std::max(out, least(without({{{variable, 1}}, 0, true}, kept, 1 / same->second), depth - 2));
  return out;
}

} // namespace dotek::lint
