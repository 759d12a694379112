#include "frontend/gibbs/LowerWalk.h"
#include "ir/Evaluate.h"
#include "support/messages/Gibbs.h"

#include <algorithm>

namespace dotek::frontend::gibbs {
namespace {

Relation relationOf(ir::Relation relation) {
  switch (relation) {
  case ir::Relation::Same:
  case ir::Relation::Equal: return Relation::Equal;
  case ir::Relation::Different:
  case ir::Relation::NotEqual: return Relation::NotEqual;
  case ir::Relation::Less: return Relation::Less;
  case ir::Relation::Greater: return Relation::Greater;
  case ir::Relation::LessEqual: return Relation::LessEqual;
  case ir::Relation::GreaterEqual: return Relation::GreaterEqual;
  }
  return Relation::Equal;
}

// 1: bounds from below; -1: from above.
int sideOf(Relation relation) {
  if (relation == Relation::Greater || relation == Relation::GreaterEqual) return 1;
  return relation == Relation::Less || relation == Relation::LessEqual ? -1 : 0;
}

// Whether the facts leave only values of `value` that are in `relation` to 0.
bool proven(const Facts& facts, const Value& value, Relation relation) {
  if (const double* number = std::get_if<double>(&value)) return holds(*number, relation, 0);
  const Question question = questionOf(*unknownIn(value), relation, {});
  const auto known = facts.find(question.key);
  return known != facts.end() && known->second.range.answer(question.relation, question.bound) == true;
}

} // namespace

bool provenAbove(const Facts& facts, const Value& value) {
  return proven(facts, value, Relation::Greater);
}
bool provenBelow(const Facts& facts, const Value& value) {
  return proven(facts, value, Relation::Less);
}
bool provenZero(const Facts& facts, const Value& value) {
  return proven(facts, value, Relation::Equal) ||
         (proven(facts, value, Relation::LessEqual) && proven(facts, value, Relation::GreaterEqual));
}
bool provenNotAbove(const Facts& facts, const Value& value) {
  return proven(facts, value, Relation::LessEqual);
}
bool provenNotBelow(const Facts& facts, const Value& value) {
  return proven(facts, value, Relation::GreaterEqual);
}

bool isWidened(const Value& value) {
  const Unknown* unknown = unknownIn(value);
  return unknown != nullptr &&
         std::any_of(unknown->sources.begin(), unknown->sources.end(),
                     [](const Symbol& symbol) { return symbol.kind == Symbol::Kind::Widened; });
}

// Equal texts are equal values.
Value Walk::opaque(const std::string& text, const std::vector<Value>& from) {
  const std::size_t number = interned_.emplace(text, interned_.size()).first->second;
  return opaqueValue(Symbol::derived(number), sourcesOf(from), "", false);
}

std::optional<Value> Walk::read(WalkState& state, ir::VariableId variable, SourceRange range) {
  const std::optional<Value>& value = valueOf(state, variable);
  if (value) return value;
  result_.unset.insert(variable);
  if (options_.unsetZero) return Value(0.0);
  result_.refusals.push_back(makeDiagnostic<diag::ReadBeforeSet>(range, cycle_.variables[variable].name));
  failed_ = true;
  return std::nullopt;
}

std::optional<Value> Walk::evaluate(WalkState& state, const ir::ExpressionPtr& e) {
  using Result = std::optional<Value>;
  return match(
      *e, [](const ir::Constant& node) -> Result { return Value(node.value); },
      [&](const ir::VariableUse& node) { return read(state, node.variable, e->range); },
      [&](const ir::Unary& node) { return evaluate(state, node); },
      [&](const ir::Binary& node) { return evaluate(state, node); },
      [&](const ir::OneOf<ir::NullValue, ir::MachineVariable, ir::MeasuredResult> auto&) -> Result {
        failed_ = true;
        return std::nullopt;
      });
}

std::optional<Value> Walk::evaluate(WalkState& state, const ir::Unary& node) {
  const auto operand = evaluate(state, node.operand);
  if (!operand) return std::nullopt;
  if (const double* known = std::get_if<double>(&*operand)) {
    const ir::Computed result = ir::compute(node.op, *known);
    if (result.ok()) return Value(result.value);
    failed_ = true; // the control stops here with an alarm
    return std::nullopt;
  }
  if (node.op == ir::UnaryOp::Negate) {
    if (const auto form = linear(*operand, -1, 0.0, 0)) return form;
  }
  return opaque(fmt::format("{}({})", static_cast<int>(node.op), canonical(*operand)), {*operand});
}

std::optional<Value> Walk::evaluate(WalkState& state, const ir::Binary& node) {
  const auto left = evaluate(state, node.left);
  if (!left) return std::nullopt;
  const auto right = evaluate(state, node.right);
  if (!right) return std::nullopt;
  const Combined result = combine(node.op, *left, *right);
  if (result.value) return result.value;
  if (result.error != ir::ArithmeticError::None) {
    failed_ = true;
    return std::nullopt;
  }
  return opaque(fmt::format("({}){}({})", canonical(*left), static_cast<int>(node.op), canonical(*right)),
                {*left, *right});
}

std::optional<bool> Walk::decide(WalkState& state, const ir::ConditionPtr& condition) {
  question_.reset();
  failed_ = false;
  if (const auto* truth = std::get_if<ir::Truth>(&condition->node)) return truth->value;
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node))
    return decide(state, *comparison);
  if (const auto* inverted = std::get_if<ir::Not>(&condition->node)) {
    const auto inner = decide(state, inverted->inner);
    return inner ? std::optional(!*inner) : std::nullopt;
  }
  const auto* junction = std::get_if<ir::Junction>(&condition->node);
  if (junction == nullptr) {
    failed_ = true;
    return std::nullopt;
  }
  const bool decisive = junction->op == ir::Connective::Or;
  const auto left = decide(state, junction->left);
  if (!left && failed_) return std::nullopt;
  const auto open = question_;
  if (left && *left == decisive) return decisive;
  const auto right = decide(state, junction->right);
  if (!right && failed_) return std::nullopt;
  if (right && *right == decisive) return decisive;
  if (left && right) return !decisive;
  if (open) question_ = open;
  return std::nullopt;
}

std::optional<bool> Walk::decide(WalkState& state, const ir::Comparison& comparison) {
  const auto left = evaluate(state, comparison.left);
  const auto right = left ? evaluate(state, comparison.right) : std::nullopt;
  if (!right) return std::nullopt;
  return compare(state, *left, relationOf(comparison.relation), *right);
}

std::optional<bool> Walk::compare(const WalkState& state, const Value& left, Relation relation,
                                  const Value& right) {
  const double* a = std::get_if<double>(&left);
  const double* b = std::get_if<double>(&right);
  if (a != nullptr && b != nullptr) return holds(*a, relation, *b);
  const auto form = linear(left, 1, right, -1);
  const Value difference = form ? *form : opaque(canonical(left) + "-" + canonical(right), {left, right});
  const Unknown* unknown = unknownIn(difference);
  if (unknown == nullptr) return holds(std::get<double>(difference), relation, 0);
  Question question = questionOf(*unknown, relation, {});
  const auto learnt = state.facts.find(question.key);
  if (learnt != state.facts.end()) {
    if (const auto answer = learnt->second.range.answer(question.relation, question.bound)) return answer;
  }
  question_ = std::move(question);
  return std::nullopt;
}

void Walk::learn(WalkState& state, const Question& question, Relation relation) {
  if (!options_.facts) return;
  Fact& fact = state.facts[question.key];
  fact.range.restrict(relation, question.bound);
  fact.symbols = question.sources;
  if (fact.reduced) return;
  const std::pair<Relation, double> added{relation, question.bound};
  std::size_t place = 0;
  if (relation == Relation::Equal) {
    // One value is all there is to know.
    fact.learnt = std::vector{added};
    fact.numbers = {};
  } else {
    // What was open is narrower than what was known before on its side.
    const auto wider = [&](const auto& known) {
      return sideOf(known.first) != 0 && sideOf(known.first) == sideOf(relation);
    };
    const auto first = std::find_if(fact.learnt.begin(), fact.learnt.end(), wider);
    place = static_cast<std::size_t>(first - fact.learnt.begin());
    fact.learnt.erase(std::remove_if(first, fact.learnt.end(), wider), fact.learnt.end());
    const auto at = std::upper_bound(fact.learnt.begin(), fact.learnt.end(), added);
    place = std::min(place, static_cast<std::size_t>(at - fact.learnt.begin()));
    fact.learnt.insert(at, added);
  }
  fact.numbers.resize(place);
  for (; place < fact.learnt.size(); ++place) {
    bytes_ = fmt::format("{} {} ", static_cast<int>(fact.learnt[place].first),
                         place == 0 ? 0 : fact.numbers[place - 1]);
    appendKey(bytes_, Value(fact.learnt[place].second));
    fact.numbers.push_back(numberOf(bytes_));
  }
}

} // namespace dotek::frontend::gibbs
