#include "frontend/gibbs/BuildTree.h"
#include "support/messages/Common.h"

namespace dotek::frontend::gibbs {

namespace {

template <class Node> StatementPtr make(SourceRange range, Node node) {
  auto made = std::make_unique<Statement>();
  made->range = range;
  made->node = std::move(node);
  return made;
}

bool isTextual(const Expression& expression) {
  if (std::holds_alternative<TextLiteral>(expression.node)) return true;
  if (const auto* variable = std::get_if<VariableRef>(&expression.node)) return variable->name.isText();
  if (std::holds_alternative<FunctionCall>(expression.node)) return true;
  if (const auto* binary = std::get_if<Binary>(&expression.node))
    return isTextual(*binary->left) || isTextual(*binary->right);
  if (const auto* bracketed = std::get_if<Bracketed>(&expression.node)) return isTextual(*bracketed->inner);
  return false;
}

} // namespace

StatementPtr TreeBuilder::errorStatement(SourceRange range) {
  return make(range, ErrorStatement{});
}

// A file name without quotes ends at a blank: what follows needs a comma.
std::string TreeBuilder::bareName(SourceRange range) {
  const std::string text = lines_.textOf(range);
  const std::size_t blank = text.find_first_of(" \t\f\v");
  if (blank != std::string::npos)
    lines_.report<diag::SyntaxError>({range.file, range.begin + static_cast<std::uint32_t>(blank), range.end},
                                     "a file name without quotes holds no blank; put it between quotes; "
                                     "arguments are separated by commas");
  return text;
}

CallMacro TreeBuilder::callMacro(MacroParser::CallStatementContext& tree) {
  CallMacro made;
  const std::vector<MacroParser::SumContext*> sums = tree.sum();
  std::size_t firstArgument = 0;
  if (tree.bareFile() != nullptr) {
    made.macroRange = at(*tree.bareFile());
    made.bareName = bareName(made.macroRange);
  } else {
    made.macroRange = at(*sums[0]);
    ExpressionPtr target = sum(*sums[0]);
    // `CALL part` names a file; a number is no name of a macro.
    if (isTextual(*target))
      made.macro = std::move(target);
    else
      made.bareName = bareName(made.macroRange);
    firstArgument = 1;
  }
  for (std::size_t i = firstArgument; i < sums.size(); ++i)
    made.arguments.push_back(sum(*sums[i]));
  return made;
}

Include TreeBuilder::include(MacroParser::IncludeStatementContext& tree) {
  Include made;
  if (tree.textLiteral() != nullptr) {
    made.fileRange = at(*tree.textLiteral());
    const std::string whole = lines_.textOf(made.fileRange);
    made.file = whole.substr(1, whole.size() - 2);
    return made;
  }
  made.fileRange = at(*tree.bareFile());
  made.file = bareName(made.fileRange);
  return made;
}

StatementPtr TreeBuilder::statement(MacroParser::StatementContext& tree) {
  const SourceRange range = at(tree);
  if (auto* assign = tree.assignment())
    return make(range, Assignment{variable(*assign->variable()), sum(*assign->sum())});
  if (auto* branch = tree.ifStatement()) {
    If made;
    made.ifRange = lines_.rangeOf(*branch->KW_IF()->getSymbol());
    made.condition = condition(*branch->condition());
    if (branch->COMMA() != nullptr) made.commaBeforeThen = lines_.rangeOf(*branch->COMMA()->getSymbol());
    made.thenRange = lines_.rangeOf(*branch->KW_THEN()->getSymbol());
    if (branch->statement() != nullptr) made.then = statement(*branch->statement());
    return make(range, std::move(made));
  }
  if (auto* loop = tree.forStatement()) {
    const std::vector<MacroParser::SumContext*> sums = loop->sum();
    return make(range, For{name(*loop->NAME()), sum(*sums[0]), sum(*sums[1]),
                           sums.size() > 2 ? sum(*sums[2]) : nullptr});
  }
  if (auto* next = tree.nextStatement()) {
    Next made;
    if (next->NAME() != nullptr) made.variable = name(*next->NAME());
    return make(range, std::move(made));
  }
  if (tree.continueStatement() != nullptr) return make(range, Continue{});
  if (auto* jump = tree.gotoStatement()) return make(range, Goto{name(*jump->NAME())});
  if (auto* call = tree.callStatement()) return make(range, callMacro(*call));
  if (auto* args = tree.argsStatement()) {
    Args made;
    for (MacroParser::VariableContext* each : args->variable())
      made.names.push_back(variable(*each));
    return make(range, std::move(made));
  }
  if (auto* declared = tree.declaration()) {
    Declaration made;
    made.scope = declared->KW_GLOBAL() != nullptr  ? Scope::Global
                 : declared->KW_LOCAL() != nullptr ? Scope::Local
                                                   : Scope::Permanent;
    for (MacroParser::VariableContext* each : declared->variable())
      made.names.push_back(variable(*each));
    return make(range, std::move(made));
  }
  if (auto* included = tree.includeStatement()) return make(range, include(*included));
  if (auto* handler = tree.onErrorStatement()) return make(range, OnError{name(*handler->NAME())});
  if (auto* command = tree.command()) {
    Command made;
    made.name = name(*command->COMMAND());
    for (antlr4::tree::ParseTree* child : command->children)
      if (command->children.size() > 1 && child == command->children[1])
        if (auto* node = dynamic_cast<antlr4::tree::TerminalNode*>(child))
          made.commaAfterName = lines_.rangeOf(*node->getSymbol());
    for (MacroParser::SumContext* argument : command->sum())
      made.arguments.push_back(sum(*argument));
    return make(range, std::move(made));
  }
  return errorStatement(range);
}

} // namespace dotek::frontend::gibbs
