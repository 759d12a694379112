#include "frontend/gibbs/Unverified.h"

#include "frontend/gibbs/Walk.h"

namespace dotek::frontend::gibbs {

ValueType typeOf(const Expression& expression, const stdlib::GibbsKeywords& keywords) {
  if (std::holds_alternative<TextLiteral>(expression.node)) return ValueType::Text;
  if (const auto* variable = std::get_if<VariableRef>(&expression.node))
    return variable->name.isText() ? ValueType::Text : ValueType::Number;
  if (const auto* call = std::get_if<FunctionCall>(&expression.node)) {
    const stdlib::FunctionSpec* spec = keywords.function(call->name.text);
    if (spec == nullptr) return call->name.isText() ? ValueType::Text : ValueType::Number;
    return spec->result == 't' ? ValueType::Text : ValueType::Number;
  }
  if (const auto* binary = std::get_if<Binary>(&expression.node)) {
    // A chain of operators leans to the left and may be long: no recursion there.
    const Expression* left = binary->left.get();
    if (typeOf(*binary->right, keywords) == ValueType::Text) return ValueType::Text;
    while (const auto* inner = std::get_if<Binary>(&left->node)) {
      if (typeOf(*inner->right, keywords) == ValueType::Text) return ValueType::Text;
      left = inner->left.get();
    }
    return typeOf(*left, keywords);
  }
  if (const auto* bracketed = std::get_if<Bracketed>(&expression.node))
    return typeOf(*bracketed->inner, keywords);
  return ValueType::Number;
}

namespace {

void addName(const Name& name, std::vector<Unverified>& found) {
  if (name.text.size() > (name.isText() ? 33U : 32U)) found.push_back({"long-name", name.range});
}

void addReference(const VariableRef& reference, SourceRange range, std::vector<Unverified>& found) {
  addName(reference.name, found);
  if (reference.index != nullptr)
    found.push_back({reference.bracket == '(' ? "array-round" : "array-square", range});
}

void addNode(const Expression& expression, const stdlib::GibbsKeywords& keywords,
             std::vector<Unverified>& found) {
  if (const auto* number = std::get_if<NumberLiteral>(&expression.node)) {
    const std::string& text = number->text;
    if (text.find_first_of("eE") != std::string::npos)
      found.push_back({"exponent", expression.range});
    else if (text.front() == '.' || text.back() == '.')
      found.push_back({"bare-fraction", expression.range});
  } else if (const auto* literal = std::get_if<TextLiteral>(&expression.node)) {
    if (literal->quote == '\'') found.push_back({"single-quotes", expression.range});
    if (literal->quote == '"' && literal->text.find('"') != std::string::npos)
      found.push_back({"doubled-quote", expression.range});
    if (literal->quote == 0) found.push_back({"loose-caption", expression.range});
  } else if (const auto* reference = std::get_if<VariableRef>(&expression.node)) {
    addReference(*reference, expression.range, found);
  } else if (const auto* binary = std::get_if<Binary>(&expression.node)) {
    // Both sides, so that a chain of sums is looked at once and not once a link.
    if (binary->op == BinaryOperator::Add && (typeOf(*binary->right, keywords) == ValueType::Text ||
                                              (!std::holds_alternative<Binary>(binary->left->node) &&
                                               typeOf(*binary->left, keywords) == ValueType::Text)))
      found.push_back({"text-join", expression.range});
  }
}

} // namespace

std::vector<Unverified> unverifiedIn(const Expression& expression, const stdlib::GibbsKeywords& keywords) {
  std::vector<Unverified> found;
  walkExpression(expression, [&](const Expression& each) { addNode(each, keywords, found); });
  return found;
}

std::vector<Unverified> unverifiedIn(const Statement& statement, const stdlib::GibbsKeywords& keywords) {
  std::vector<Unverified> found;
  if (const auto* branch = std::get_if<If>(&statement.node)) {
    for (const Comparison& comparison : branch->condition.comparisons) {
      if (!comparison.nots.empty()) found.push_back({"not", comparison.nots.front()});
      if (!comparison.brackets.empty()) found.push_back({"condition-brackets", comparison.brackets.front()});
      if (typeOf(*comparison.left, keywords) == ValueType::Text ||
          typeOf(*comparison.right, keywords) == ValueType::Text)
        found.push_back({"text-comparison", comparison.range});
    }
    if (!branch->condition.connectives.empty()) found.push_back({"and-or", branch->condition.range});
    if (branch->then == nullptr) found.push_back({"block-if", branch->ifRange});
    if (branch->elseRange) found.push_back({"else", *branch->elseRange});
  } else if (const auto* assign = std::get_if<Assignment>(&statement.node)) {
    addReference(assign->target, assign->target.name.range, found);
  } else if (const auto* loop = std::get_if<For>(&statement.node)) {
    addName(loop->variable, found);
    if (loop->step != nullptr)
      if (const auto* unary = std::get_if<Unary>(&loop->step->node);
          unary != nullptr && unary->op == UnaryOperator::Minus)
        found.push_back({"negative-step", loop->step->range});
  } else if (const auto* next = std::get_if<Next>(&statement.node)) {
    if (!next->variable) found.push_back({"next-without-name", statement.range});
  } else if (const auto* call = std::get_if<CallMacro>(&statement.node)) {
    if (call->macro == nullptr) found.push_back({"bare-file", call->macroRange});
  } else if (const auto* args = std::get_if<Args>(&statement.node)) {
    for (const VariableRef& name : args->names)
      addReference(name, name.name.range, found);
  } else if (const auto* declared = std::get_if<Declaration>(&statement.node)) {
    for (const VariableRef& name : declared->names)
      addReference(name, name.name.range, found);
  }
  ownExpressions(statement, [&](const Expression& expression) {
    for (const Unverified& each : unverifiedIn(expression, keywords))
      found.push_back(each);
  });
  return found;
}

} // namespace dotek::frontend::gibbs
