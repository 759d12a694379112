// Parse tree of one line to syntax tree nodes. Included by builder sources only (ANTLR).
#pragma once

#include "frontend/gibbs/Lines.h"

namespace dotek::frontend::gibbs {

using MacroParser = grammar::GibbsMacroParser;

class TreeBuilder {
public:
  explicit TreeBuilder(Lines& lines) : lines_(lines) {}

  // ---- BuildExpression.cpp
  ExpressionPtr sum(MacroParser::SumContext& tree);
  Condition condition(MacroParser::ConditionContext& tree);
  // A comparison without brackets.
  Comparison comparison(MacroParser::SumContext& left, MacroParser::RelationContext& relation,
                        MacroParser::SumContext& right);
  VariableRef variable(MacroParser::VariableContext& tree);
  Name name(antlr4::tree::TerminalNode& node);

  // ---- BuildStatement.cpp
  // One line of .mac; an IF with nothing after THEN has no `then`.
  StatementPtr statement(MacroParser::StatementContext& tree);
  StatementPtr errorStatement(SourceRange range);

private:
  ExpressionPtr product(MacroParser::ProductContext& tree);
  ExpressionPtr factor(MacroParser::FactorContext& tree);
  ExpressionPtr number(const antlr4::Token& token);
  ExpressionPtr text(MacroParser::TextLiteralContext& tree);
  ExpressionPtr named(MacroParser::NameValueContext& tree);
  void addComparison(MacroParser::ComparisonContext& tree, Condition& condition,
                     std::vector<SourceRange> nots, std::vector<SourceRange> brackets);

  CallMacro callMacro(MacroParser::CallStatementContext& tree);
  Include include(MacroParser::IncludeStatementContext& tree);
  std::string bareName(SourceRange range);

  SourceRange at(antlr4::ParserRuleContext& tree) const { return lines_.rangeOf(tree); }

  Lines& lines_;
};

} // namespace dotek::frontend::gibbs
