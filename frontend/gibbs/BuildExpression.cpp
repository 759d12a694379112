#include "frontend/gibbs/BuildTree.h"
#include "support/messages/Common.h"
#include "support/messages/Gibbs.h"

#include <charconv>

namespace dotek::frontend::gibbs {

using Lexer = grammar::GibbsMacroLexer;

namespace {

template <class Node> ExpressionPtr make(SourceRange range, Node node) {
  auto made = std::make_unique<Expression>();
  made->range = range;
  made->node = std::move(node);
  return made;
}

Relation relationOf(std::size_t type) {
  switch (type) {
  case Lexer::NOT_EQUAL: return Relation::NotEqual;
  case Lexer::LESS: return Relation::Less;
  case Lexer::GREATER: return Relation::Greater;
  case Lexer::LESS_EQUAL: return Relation::LessEqual;
  case Lexer::GREATER_EQUAL: return Relation::GreaterEqual;
  default: return Relation::Equal;
  }
}

std::size_t tokenType(antlr4::tree::ParseTree* tree) {
  auto* node = dynamic_cast<antlr4::tree::TerminalNode*>(tree);
  return node == nullptr ? 0 : node->getSymbol()->getType();
}

} // namespace

Name TreeBuilder::name(antlr4::tree::TerminalNode& node) {
  const SourceRange range = lines_.rangeOf(*node.getSymbol());
  std::string text;
  bool blank = false;
  for (const char c : lines_.textOf(range)) {
    if (c == ' ' || c == '\t' || c == '\f' || c == '\v')
      blank = true;
    else
      text += c;
  }
  if (blank) lines_.report<diag::BlankInName>(range, text);
  return {range, text};
}

ExpressionPtr TreeBuilder::sum(MacroParser::SumContext& tree) {
  const std::vector<MacroParser::ProductContext*> parts = tree.product();
  ExpressionPtr left = product(*parts[0]);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const bool plus = tokenType(tree.children[2 * i - 1]) == Lexer::PLUS;
    ExpressionPtr right = product(*parts[i]);
    const SourceRange range = spanning(left->range, right->range);
    left = make(range, Binary{plus ? BinaryOperator::Add : BinaryOperator::Subtract, std::move(left),
                              std::move(right)});
  }
  return left;
}

ExpressionPtr TreeBuilder::product(MacroParser::ProductContext& tree) {
  const std::vector<MacroParser::FactorContext*> parts = tree.factor();
  ExpressionPtr left = factor(*parts[0]);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const bool times = tokenType(tree.children[2 * i - 1]) == Lexer::STAR;
    ExpressionPtr right = factor(*parts[i]);
    const SourceRange range = spanning(left->range, right->range);
    left = make(range, Binary{times ? BinaryOperator::Multiply : BinaryOperator::Divide, std::move(left),
                              std::move(right)});
  }
  return left;
}

ExpressionPtr TreeBuilder::number(const antlr4::Token& token) {
  const SourceRange range = lines_.rangeOf(token);
  NumberLiteral literal{0, lines_.textOf(range)};
  const char* end = literal.text.data() + literal.text.size();
  if (std::from_chars(literal.text.data(), end, literal.value).ec != std::errc()) {
    lines_.report<diag::SyntaxError>(range, "the number is outside what a variable can hold");
    return make(range, ErrorExpression{});
  }
  return make(range, std::move(literal));
}

ExpressionPtr TreeBuilder::text(MacroParser::TextLiteralContext& tree) {
  const SourceRange range = at(tree);
  const std::string whole = lines_.textOf(range);
  return make(range, TextLiteral{whole.substr(1, whole.size() - 2), whole[0]});
}

ExpressionPtr TreeBuilder::named(MacroParser::NameValueContext& tree) {
  const Name called = name(*tree.NAME());
  if (tree.arguments() == nullptr) return make(at(tree), VariableRef{called, nullptr, 0});
  std::vector<ExpressionPtr> arguments;
  for (MacroParser::SumContext* argument : tree.arguments()->sum())
    arguments.push_back(sum(*argument));
  if (tree.arguments()->LEFT_SQUARE() != nullptr)
    return make(at(tree), VariableRef{called, std::move(arguments[0]), '['});
  if (lines_.context().keywords.function(called.text) == nullptr && arguments.size() == 1)
    return make(at(tree), VariableRef{called, std::move(arguments[0]), '('});
  return make(at(tree), FunctionCall{called, std::move(arguments)});
}

ExpressionPtr TreeBuilder::factor(MacroParser::FactorContext& tree) {
  if (auto* value = dynamic_cast<MacroParser::SignedValueContext*>(&tree))
    return make(at(tree), Unary{value->PLUS() != nullptr ? UnaryOperator::Plus : UnaryOperator::Minus,
                                factor(*value->factor())});
  if (auto* value = dynamic_cast<MacroParser::NumberValueContext*>(&tree))
    return number(*value->NUMBER()->getSymbol());
  if (auto* value = dynamic_cast<MacroParser::TextValueContext*>(&tree)) return text(*value->textLiteral());
  if (auto* value = dynamic_cast<MacroParser::NameValueContext*>(&tree)) return named(*value);
  if (auto* value = dynamic_cast<MacroParser::BracketValueContext*>(&tree))
    return make(at(tree), Bracketed{sum(*value->sum())});
  return make(at(tree), ErrorExpression{});
}

VariableRef TreeBuilder::variable(MacroParser::VariableContext& tree) {
  VariableRef made{name(*tree.NAME()), nullptr, 0};
  if (MacroParser::IndexContext* index = tree.index()) {
    made.index = sum(*index->sum());
    made.bracket = index->LEFT_ROUND() != nullptr ? '(' : '[';
  }
  return made;
}

Comparison TreeBuilder::comparison(MacroParser::SumContext& left, MacroParser::RelationContext& relation,
                                   MacroParser::SumContext& right) {
  Comparison made;
  made.range = spanning(at(left), at(right));
  made.left = sum(left);
  made.relation = relationOf(relation.getStart()->getType());
  made.relationRange = at(relation);
  made.right = sum(right);
  return made;
}

void TreeBuilder::addComparison(MacroParser::ComparisonContext& tree, Condition& condition,
                                std::vector<SourceRange> nots, std::vector<SourceRange> brackets) {
  if (auto* negated = dynamic_cast<MacroParser::NegatedComparisonContext*>(&tree)) {
    nots.push_back(lines_.rangeOf(*negated->KW_NOT()->getSymbol()));
    addComparison(*negated->comparison(), condition, std::move(nots), std::move(brackets));
  } else if (auto* bracketed = dynamic_cast<MacroParser::BracketedComparisonContext*>(&tree)) {
    brackets.push_back(at(tree));
    addComparison(*bracketed->comparison(), condition, std::move(nots), std::move(brackets));
  } else if (auto* plain = dynamic_cast<MacroParser::PlainComparisonContext*>(&tree)) {
    Comparison made = comparison(*plain->sum(0), *plain->relation(), *plain->sum(1));
    made.nots = std::move(nots);
    made.brackets = std::move(brackets);
    condition.comparisons.push_back(std::move(made));
  }
}

Condition TreeBuilder::condition(MacroParser::ConditionContext& tree) {
  Condition made;
  made.range = at(tree);
  for (MacroParser::ComparisonContext* part : tree.comparison())
    addComparison(*part, made, {}, {});
  for (antlr4::tree::ParseTree* child : tree.children) {
    if (tokenType(child) == Lexer::KW_AND) made.connectives.push_back(Connective::And);
    if (tokenType(child) == Lexer::KW_OR) made.connectives.push_back(Connective::Or);
  }
  return made;
}

} // namespace dotek::frontend::gibbs
