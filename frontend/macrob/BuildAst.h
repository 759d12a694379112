// Parse trees of the generated parser to the syntax tree. Included by builder sources only.
#pragma once

#include "frontend/macrob/Ast.h"
#include "frontend/macrob/Forms.h"
#include "frontend/macrob/Tokens.h"
#include "support/Diagnostics.h"

#include <MacroBParser.h>

#include <optional>
#include <string>

namespace dotek::frontend::macrob {

// The tree of one block. What the grammar takes and the language does not is put into `error`, the first of
// it.
class Builder {
public:
  Builder(FileId file, Forms forms) : file_(file), forms_(forms) {}

  Block block(grammar::MacroBParser::BlockContext& context);
  // nullopt: the block is good.
  const std::optional<Diagnostic>& error() const { return error_; }

private:
  using Parser = grammar::MacroBParser;

  // A number, or a condition: which one a bracket holds shows late.
  struct Value {
    ExpressionPtr number;
    ConditionPtr condition;
  };

  SourceRange rangeOf(const antlr4::Token& token) const { return frontend::rangeOf(file_, token); }
  SourceRange rangeOf(const antlr4::ParserRuleContext& context) const {
    return frontend::rangeOf(file_, context);
  }
  template <class Id, class... Args> void fail(SourceRange range, const Args&... args) {
    if (!error_) error_ = makeDiagnostic<Id>(range, args...);
  }

  Body statement(Parser::StatementContext& context);
  Words words(Parser::WordsContext& context);
  nc::Word word(const antlr4::Token& address, Parser::WordValueContext& value);
  ExpressionPtr wordValue(Parser::WordValueContext& context);
  nc::Assignment assignment(Parser::AssignmentContext& context);
  If ifStatement(Parser::IfStatementContext& context);
  ThenStatement thenStatement(Parser::ThenStatementContext& context);
  Do doStatement(Parser::DoStatementContext& context);
  Goto gotoStatement(Parser::GotoStatementContext& context);
  Print print(Parser::PrintStatementContext& context);
  SetNames setNames(Parser::NameStatementContext& context);
  LoopNumber loopNumber(const antlr4::Token& token);
  bool closed(const antlr4::Token& text);
  void printedPieces(std::string_view text, std::uint32_t begin, Print& out);

  ExpressionPtr number(Value value, SourceRange range);
  ConditionPtr condition(Parser::BracketContext& context);
  Value bracket(Parser::BracketContext& context);
  Value comparison(Parser::ComparisonContext& context);
  Value sum(Parser::SumContext& context);
  Value product(Parser::ProductContext& context);
  Value factor(Parser::FactorContext& context);
  Value joined(Value left, const std::string& op, SourceRange place, Value right);
  ExpressionPtr numberOf(const antlr4::Token& token);
  ExpressionPtr variable(Parser::VariableContext& context);
  ExpressionPtr function(Parser::FunctionContext& context);

  FileId file_;
  Forms forms_;
  std::optional<Diagnostic> error_;
};

} // namespace dotek::frontend::macrob
