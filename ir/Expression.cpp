#include "ir/Expression.h"

#include "ir/Match.h"

#include <utility>

namespace dotek::ir {
namespace {

template <class Node> ExpressionPtr make(SourceRange range, Node node) {
  const auto out = std::make_shared<Expression>();
  out->range = range;
  out->node.template emplace<Node>(std::move(node)); // moving a variant costs as much again
  return out;
}

template <class Node> ConditionPtr makeCondition(SourceRange range, Node node) {
  const auto out = std::make_shared<Condition>();
  out->range = range;
  out->node.template emplace<Node>(std::move(node));
  return out;
}

} // namespace

std::string_view resultText(ResultName name) {
  static constexpr std::string_view kTexts[] = {
#define DOTEK_RESULT(id, text, title) text,
      DOTEK_RESULTS(DOTEK_RESULT)
#undef DOTEK_RESULT
  };
  return kTexts[static_cast<std::size_t>(name)];
}

std::string_view resultTitle(ResultName name) {
  static constexpr std::string_view kTitles[] = {
#define DOTEK_RESULT(id, text, title) title,
      DOTEK_RESULTS(DOTEK_RESULT)
#undef DOTEK_RESULT
  };
  return kTitles[static_cast<std::size_t>(name)];
}

ExpressionPtr constant(double value, SourceRange range, std::string digits) {
  return make(range, Constant{value == 0 ? 0.0 : value, std::move(digits)});
}

ExpressionPtr nullValue(SourceRange range) {
  return make(range, NullValue{});
}

ExpressionPtr variable(VariableId id, SourceRange range) {
  return make(range, VariableUse{id});
}

ExpressionPtr machineVariable(ExpressionPtr number, SourceRange range) {
  return make(range, MachineVariable{std::move(number)});
}

ExpressionPtr result(ResultName name, SourceRange range) {
  return make(range, MeasuredResult{name});
}

ExpressionPtr unary(UnaryOp op, ExpressionPtr operand, SourceRange range) {
  return make(range, Unary{op, std::move(operand)});
}

ExpressionPtr binary(BinaryOp op, ExpressionPtr left, ExpressionPtr right, SourceRange range) {
  return make(range, Binary{op, std::move(left), std::move(right)});
}

const Constant* numberWithoutPoint(const ExpressionPtr& value) {
  const auto* node = value ? std::get_if<Constant>(&value->node) : nullptr;
  return node != nullptr && !node->digits.empty() && node->digits.find('.') == std::string::npos ? node
                                                                                                 : nullptr;
}

const double* constantValue(const ExpressionPtr& expression) {
  if (!expression) return nullptr;
  const auto* node = std::get_if<Constant>(&expression->node);
  return node ? &node->value : nullptr;
}

bool equal(const ExpressionPtr& a, const ExpressionPtr& b) {
  if (a == b) return true;
  if (!a || !b || a->node.index() != b->node.index()) return false;
  return match(
      *a, [&](const Constant& left) { return left.value == std::get<Constant>(b->node).value; },
      [&](const NullValue&) { return true; },
      [&](const VariableUse& left) { return left.variable == std::get<VariableUse>(b->node).variable; },
      [&](const MachineVariable& left) {
        return equal(left.number, std::get<MachineVariable>(b->node).number);
      },
      [&](const MeasuredResult& left) { return left.name == std::get<MeasuredResult>(b->node).name; },
      [&](const Unary& left) {
        const auto& right = std::get<Unary>(b->node);
        return left.op == right.op && equal(left.operand, right.operand);
      },
      [&](const Binary& left) {
        const auto& right = std::get<Binary>(b->node);
        return left.op == right.op && equal(left.left, right.left) && equal(left.right, right.right);
      });
}

bool equal(const ConditionPtr& a, const ConditionPtr& b) {
  if (a == b) return true;
  if (!a || !b || a->node.index() != b->node.index()) return false;
  return match(
      *a,
      [&](const Comparison& left) {
        const auto& right = std::get<Comparison>(b->node);
        return left.relation == right.relation && equal(left.left, right.left) &&
               equal(left.right, right.right);
      },
      [&](const IsNull& left) { return equal(left.value, std::get<IsNull>(b->node).value); },
      [&](const Not& left) { return equal(left.inner, std::get<Not>(b->node).inner); },
      [&](const Junction& left) {
        const auto& right = std::get<Junction>(b->node);
        return left.op == right.op && equal(left.left, right.left) && equal(left.right, right.right);
      },
      [&](const Truth& left) { return left.value == std::get<Truth>(b->node).value; });
}

Relation opposite(Relation relation) {
  switch (relation) {
  case Relation::Equal: return Relation::NotEqual;
  case Relation::NotEqual: return Relation::Equal;
  case Relation::Less: return Relation::GreaterEqual;
  case Relation::GreaterEqual: return Relation::Less;
  case Relation::Greater: return Relation::LessEqual;
  case Relation::LessEqual: return Relation::Greater;
  case Relation::Same: return Relation::Different;
  case Relation::Different: return Relation::Same;
  }
  return relation;
}

ConditionPtr compare(Relation relation, ExpressionPtr left, ExpressionPtr right, SourceRange range) {
  return makeCondition(range, Comparison{relation, std::move(left), std::move(right)});
}

ConditionPtr isNull(ExpressionPtr value, SourceRange range) {
  return makeCondition(range, IsNull{std::move(value)});
}

ConditionPtr join(Connective op, ConditionPtr left, ConditionPtr right, SourceRange range) {
  return makeCondition(range, Junction{op, std::move(left), std::move(right)});
}

ConditionPtr truth(bool value, SourceRange range) {
  return makeCondition(range, Truth{value});
}

namespace {

// The condition with its negations pushed inward; negated where `wanted` is false.
ConditionPtr pushed(const ConditionPtr& condition, bool wanted) {
  const SourceRange range = condition->range;
  return match(
      *condition,
      [&](const Comparison& node) {
        return wanted ? condition : compare(opposite(node.relation), node.left, node.right, range);
      },
      [&](const IsNull&) { return wanted ? condition : makeCondition(range, Not{condition}); },
      [&](const Not& node) {
        const bool plain = wanted && std::holds_alternative<IsNull>(node.inner->node);
        return plain ? condition : pushed(node.inner, !wanted);
      },
      [&](const Junction& node) {
        ConditionPtr left = pushed(node.left, wanted);
        ConditionPtr right = pushed(node.right, wanted);
        if (left == node.left && right == node.right) return condition;
        const Connective op = (node.op == Connective::And) == wanted ? Connective::And : Connective::Or;
        return join(op, std::move(left), std::move(right), range);
      },
      [&](const Truth& node) { return wanted ? condition : truth(!node.value, range); });
}

} // namespace

ConditionPtr negate(const ConditionPtr& condition) {
  return pushed(condition, false);
}

} // namespace dotek::ir
