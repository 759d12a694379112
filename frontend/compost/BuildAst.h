// Builds the syntax tree of one Prog. Included by builder sources only.
#pragma once

#include "frontend/compost/Ast.h"
#include "frontend/compost/Repair.h"
#include "frontend/compost/Tokens.h"

#include <ComPostParser.h>

#include <optional>
#include <string>
#include <vector>

namespace dotek::frontend::compost {

class Builder {
public:
  Builder(FileId file, const SourceMap& sources, TokenFindings findings, Diagnostics& diagnostics);

  // Takes one unit of the session; units come in source order.
  void item(const ParseSession::Unit& unit, antlr4::TokenStream& stream);
  // To be called once, after the last unit.
  Program finish(const TokenBuffer& tokens);

private:
  using Parser = grammar::ComPostParser;

  SourceRange rangeOf(const antlr4::Token& token) const { return frontend::rangeOf(file_, token); }
  SourceRange rangeOf(const antlr4::ParserRuleContext& context) const {
    return frontend::rangeOf(file_, context);
  }
  std::uint32_t lineOf(SourceRange range) const;
  bool quiet(SourceRange range) const;
  // Text was dropped before `range`, in the same routine: ends may be missing for that reason.
  bool losesText(SourceRange range) const;
  // Text was dropped right after `range`.
  bool cutShort(SourceRange range) const;
  void syntaxError(SourceRange range, std::string message);
  // Place of a flow keyword, without the colon that is reported.
  SourceRange keyword(const antlr4::Token& token);

  Word word(Parser::WordContext& context);
  std::vector<Literal> arguments(Parser::ArgumentsContext& context);
  std::optional<Literal> argument(Parser::ArgumentContext& context, bool& unterminated);

  // `before` is the word that the condition follows.
  Condition condition(Parser::ConditionContext& context, SourceRange before);
  ConditionTerm term(Parser::TermContext& context, SourceRange before);

  void append(std::vector<Statement>& body, SourceRange stray);
  void strayToken(const antlr4::Token& token);
  void dangling(Parser::DanglingTermContext& context, std::vector<Statement>& body);
  void strayFlow(Parser::StrayFlowContext& context, std::vector<Statement>& body);
  void entry(Parser::EntryContext& context, std::vector<Statement>& body);
  void statement(Parser::StatementContext& context, std::vector<Statement>& body);
  std::unique_ptr<If> conditional(Parser::IfStatementContext& context);

  std::optional<std::uint32_t> pictureNumber(SourceRange range);
  void directive(Parser::DirectiveContext& context, bool inRoutine);
  std::optional<Item> pictureDefinition(Parser::PictureDefinitionContext& context, SourceRange range);
  std::optional<Item> formatDirective(Parser::FormatDirectiveContext& context, SourceRange range);

  void routine(Parser::RoutineContext& context, antlr4::TokenStream& stream);
  void loose(Parser::LooseContext& context);
  void flushEnds(std::optional<SourceRange> strayEnd);
  static std::uint32_t lastStatementEnd(const Routine& routine);

  FileId file_;
  const SourceMap& sources_;
  const SourceFile& source_;
  TokenFindings findings_;
  Diagnostics& diagnostics_;
  Program program_;

  std::uint32_t errorLine_ = 0; // line of the last error
  // Of the routine that is being built, then of the last one built: its findings wait for what follows.
  std::uint32_t routineBegin_ = 0;
  std::vector<const If*> openIfs_;
  std::vector<Item> innerDirectives_; // directives inside the routine become items after it
  SourceRange lastDirective_;
  std::optional<std::size_t> pendingRoutine_; // index in items
  RoutineEnd pendingEnd_;
};

} // namespace dotek::frontend::compost
