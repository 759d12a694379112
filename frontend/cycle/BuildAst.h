// Builds the syntax tree of one cycle from the lines that the generated parser reads. Included by builder
// sources only.
#pragma once

#include "frontend/cycle/Ast.h"
#include "frontend/cycle/Tokens.h"
#include "support/Diagnostics.h"

#include <CycleParser.h>

#include <optional>
#include <string>
#include <vector>

namespace dotek::frontend::cycle {

class Builder {
public:
  using Parser = grammar::CycleParser;

  Builder(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics);

  // Comments of the file, before the first line is taken.
  void comments(const TokenBuffer& tokens);
  // Takes one unit of the session; units come in source order.
  void line(const ParseSession::Unit& unit);
  // To be called once, after the last line.
  File finish();

private:
  // A block whose `end` is still to come.
  struct Open {
    Statement statement;
    SourceRange word; // that opened it
    std::string end;  // how it begins, for messages: "if"
  };

  SourceRange rangeOf(const antlr4::Token& token) const { return frontend::rangeOf(file_.file, token); }
  SourceRange rangeOf(const antlr4::ParserRuleContext& context) const {
    return frontend::rangeOf(file_.file, context);
  }
  std::uint32_t lineOf(std::uint32_t offset) const { return source_.lineOf(offset); }
  bool blankAbove(std::uint32_t offset) const;
  std::vector<Comment> commentsBefore(std::uint32_t offset);
  // Of the comments within `range` and after it on its last line, the last becomes `after`.
  void attach(Statement& statement);
  Block& block();
  std::vector<Statement>& statements() { return block().statements; }
  void add(Statement statement);
  void open(Statement statement, SourceRange word, std::string name);
  void close(SourceRange range, bool written);
  void lost(SourceRange range);

  template <class Id, class... Args> Diagnostic& error(SourceRange range, const Args&... args) {
    file_.hasErrorNodes = true;
    return diagnostics_.report<Id>(range, args...);
  }

  // ---- BuildStatement.cpp
  void statement(Parser::StatementContext& context);
  void elsePart(SourceRange range, Parser::ExpressionContext* condition);
  Name name(Parser::NameContext& context);
  std::vector<Name> names(Parser::NamesContext& context);
  Text text(Parser::TextContext& context);
  std::optional<Text> optionalText(Parser::TextContext* context);
  Type type(Parser::TypeContext& context);
  Parameter parameter(Parser::ParameterContext& context);
  Clause clause(Parser::ClauseContext& context);
  Move move(Parser::MoveContext& context);
  Touch touch(Parser::TouchContext& context);
  static Parser::ComparisonContext* comparisonIn(Parser::ExpressionContext& context);
  std::optional<Name> nameCompared(Parser::ExpressionContext& last, Parser::TouchContext& touch);
  Coordinate coordinate(Parser::CoordinateContext& context);
  std::vector<Coordinate> coordinates(Parser::CoordinatesContext& context);
  Call call(Parser::CallContext& context);
  Axis axis(const antlr4::Token& token) const;

  // ---- BuildExpression.cpp
  ExpressionPtr expression(Parser::ExpressionContext* context);
  ExpressionPtr conjunction(Parser::ConjunctionContext& context);
  ExpressionPtr negation(Parser::NegationContext& context);
  ExpressionPtr comparison(Parser::ComparisonContext& context);
  BinaryOp comparator(Parser::ComparatorContext& context);
  ExpressionPtr sum(Parser::SumContext& context);
  ExpressionPtr product(Parser::ProductContext& context);
  ExpressionPtr factor(Parser::FactorContext& context);
  ExpressionPtr primary(Parser::PrimaryContext& context);
  ExpressionPtr number(Parser::NumberContext& context);
  ExpressionPtr workOffset(const antlr4::Token& token);

  const SourceMap& sources_;
  const SourceFile& source_;
  const Limits& limits_;
  Diagnostics& diagnostics_;
  File file_;
  std::vector<Open> open_;
  std::vector<Comment> comments_; // in source order
  std::size_t nextComment_ = 0;
};

} // namespace dotek::frontend::cycle
