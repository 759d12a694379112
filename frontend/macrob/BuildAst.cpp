#include "frontend/macrob/BuildAst.h"

#include "frontend/macrob/BlockWords.h"
#include "support/Ascii.h"
#include "support/Decimal.h"
#include "support/messages/Common.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <vector>

namespace dotek::frontend::macrob {

using Parser = grammar::MacroBParser;

namespace {

// UINT32_MAX where the digits are no whole number that fits.
std::uint32_t wholeNumber(std::string_view digits) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc{} && end == digits.data() + digits.size() && !digits.empty() ? value : UINT32_MAX;
}

ExpressionPtr expressionOf(SourceRange range, decltype(Expression::node) node) {
  auto out = std::make_unique<Expression>();
  out->range = range;
  out->node = std::move(node);
  return out;
}

// The call that the text of `left` ends with, if it is ATAN with one operand in brackets; what holds it is
// then lengthened to `end`.
nc::FunctionCall* lastArcTangent(Expression* left, std::uint32_t end) {
  std::vector<Expression*> path;
  while (left != nullptr && left->brackets == 0) {
    path.push_back(left);
    if (auto* operation = std::get_if<nc::Operation>(&left->node)) {
      left = operation->right.get();
    } else if (auto* negated = std::get_if<nc::Negated>(&left->node)) {
      left = negated->operand.get();
    } else {
      auto* call = std::get_if<nc::FunctionCall>(&left->node);
      if (call == nullptr || call->name != "ATAN" || call->bare || call->arguments.size() != 1)
        return nullptr;
      for (Expression* part : path)
        part->range.end = end;
      return call;
    }
  }
  return nullptr;
}

} // namespace

// ---- blocks
// ----------------------------------------------------------------------------------------------------------------

Block Builder::block(Parser::BlockContext& context) {
  Block out;
  if (Parser::BlockDeleteContext* mark = context.blockDelete()) {
    BlockDelete value{rangeOf(*mark), std::nullopt};
    if (mark->NUMBER() != nullptr) {
      const antlr4::Token& token = *mark->NUMBER()->getSymbol();
      value.number = wholeNumber(token.getText());
      if (*value.number < 1 || *value.number > 9)
        fail<diag::BlockDeleteNumber>(rangeOf(token), token.getText());
    }
    out.blockDelete = value;
  }
  if (Parser::SequenceNumberContext* number = context.sequenceNumber()) {
    const antlr4::Token& token = *number->NUMBER()->getSymbol();
    SequenceNumber value{rangeOf(*number), token.getText(), UINT64_MAX};
    const std::string& digits = value.digits;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value.value);
    if (error != std::errc{} || end != digits.data() + digits.size()) {
      value.value = UINT64_MAX;
      fail<diag::SequenceNumberForm>(rangeOf(token), digits);
    }
    out.sequenceNumber = std::move(value);
  }
  if (context.statement() != nullptr) out.body = statement(*context.statement());
  return out;
}

Body Builder::statement(Parser::StatementContext& context) {
  if (auto* part = context.words()) return words(*part);
  if (auto* part = context.assignment()) return assignment(*part);
  if (auto* part = context.ifStatement()) return ifStatement(*part);
  if (auto* part = context.doStatement()) return doStatement(*part);
  if (auto* part = context.gotoStatement()) return gotoStatement(*part);
  if (auto* part = context.printStatement()) return print(*part);
  if (auto* part = context.portStatement()) return Port{part->getStart()->getText().starts_with("PO")};
  if (auto* part = context.nameStatement()) return setNames(*part);
  if (auto* part = context.endStatement()) {
    End end{rangeOf(*part), std::nullopt};
    if (part->NUMBER() != nullptr) end.loop = loopNumber(*part->NUMBER()->getSymbol());
    return end;
  }
  if (auto* part = context.whileStatement()) {
    Do loop = doStatement(*part->doStatement());
    loop.range = rangeOf(*part);
    loop.condition = condition(*part->bracket());
    return loop;
  }
  return std::monostate{};
}

Words Builder::words(Parser::WordsContext& context) {
  Words out;
  out.words.push_back(word(*context.ADDRESS()->getSymbol(), *context.wordValue()));
  for (Parser::WordContext* part : context.word())
    out.words.push_back(word(*part->getStart(), *part->wordValue()));
  return out;
}

nc::Word Builder::word(const antlr4::Token& address, Parser::WordValueContext& value) {
  nc::Word out;
  const std::string text = address.getText();
  out.address = text.size() == 2 ? commaAddress(text[1]) : text.front();
  out.range = spanning(rangeOf(address), rangeOf(value));
  out.value = wordValue(value);
  return out;
}

ExpressionPtr Builder::wordValue(Parser::WordValueContext& context) {
  ExpressionPtr value;
  if (context.NUMBER() != nullptr)
    value = numberOf(*context.NUMBER()->getSymbol());
  else if (context.variable() != nullptr)
    value = variable(*context.variable());
  else
    value = number(bracket(*context.bracket()), rangeOf(*context.bracket()));
  if (context.sign() == nullptr || context.sign()->MINUS() == nullptr) return value;
  return expressionOf(rangeOf(context), nc::Negated{std::move(value)});
}

nc::Assignment Builder::assignment(Parser::AssignmentContext& context) {
  nc::Assignment out;
  out.range = rangeOf(context);
  ExpressionPtr target = variable(*context.variable());
  out.variable = std::move(std::get<nc::VariableRef>(target->node).number);
  out.value = number(comparison(*context.comparison()), rangeOf(*context.comparison()));
  return out;
}

If Builder::ifStatement(Parser::IfStatementContext& context) {
  If out;
  out.range = rangeOf(context);
  out.condition = condition(*context.bracket());
  if (context.thenStatement() != nullptr) {
    out.then = true;
    out.statement = thenStatement(*context.thenStatement());
  } else {
    out.statement = gotoStatement(*context.gotoStatement());
  }
  return out;
}

ThenStatement Builder::thenStatement(Parser::ThenStatementContext& context) {
  if (auto* part = context.assignment()) return assignment(*part);
  if (auto* part = context.gotoStatement()) return gotoStatement(*part);
  if (auto* part = context.printStatement()) return print(*part);
  if (auto* part = context.portStatement()) return Port{part->getStart()->getText().starts_with("PO")};
  if (auto* part = context.nameStatement()) return setNames(*part);
  if (forms_.thenOptional)
    fail<diag::BlockAfterCondition>(rangeOf(context));
  else
    fail<diag::ThenTakesMacroStatement>(rangeOf(context));
  return Port{};
}

Do Builder::doStatement(Parser::DoStatementContext& context) {
  Do out;
  out.range = rangeOf(context);
  if (context.NUMBER() != nullptr) out.loop = loopNumber(*context.NUMBER()->getSymbol());
  return out;
}

LoopNumber Builder::loopNumber(const antlr4::Token& token) {
  return {rangeOf(token), token.getText(), wholeNumber(token.getText())};
}

Goto Builder::gotoStatement(Parser::GotoStatementContext& context) {
  return {rangeOf(context), wordValue(*context.wordValue())};
}

// ---- DPRNT, SETVN
// ----------------------------------------------------------------------------------------------------------

bool Builder::closed(const antlr4::Token& text) {
  const std::string spelling = text.getText();
  const auto count = [&](char c) { return std::count(spelling.begin(), spelling.end(), c); };
  if (count('[') == count(']')) return true;
  fail<diag::BracketsDoNotMatch>(rangeOf(text), count('['), count(']'));
  return false;
}

Print Builder::print(Parser::PrintStatementContext& context) {
  const antlr4::Token& text = *context.PRINT_TEXT()->getSymbol();
  Print out;
  out.binary = context.getStart()->getText().front() == 'B';
  out.range = rangeOf(text);
  if (!closed(text)) return out;
  const std::string spelling = text.getText();
  printedPieces(std::string_view(spelling).substr(1, spelling.size() - 2), out.range.begin + 1, out);
  return out;
}

void Builder::printedPieces(std::string_view text, std::uint32_t begin, Print& out) {
  std::string plain;
  const auto flush = [&] {
    if (!plain.empty()) out.pieces.emplace_back(PrintedText{std::exchange(plain, {})});
  };
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] != '#') {
      plain += text[at++];
      continue;
    }
    const std::size_t start = at++;
    const auto skip = [&] {
      while (at < text.size() && text[at] == ' ')
        ++at;
    };
    const auto digits = [&] {
      skip();
      std::string value;
      while (at < text.size() && isDigit(text[at]))
        value += text[at++];
      skip();
      return value;
    };
    PrintedVariable variable;
    variable.variable = wholeNumber(digits());
    bool good = variable.variable != UINT32_MAX && at < text.size() && text[at] == '[';
    if (good) {
      ++at;
      variable.format = digits();
      good = !variable.format.empty() && variable.format.size() <= 2 && at < text.size() && text[at] == ']';
    }
    if (!good) {
      const auto place = static_cast<std::uint32_t>(begin + start);
      fail<diag::PrintedVariableForm>(SourceRange{file_, place, place + 1});
      return;
    }
    ++at;
    flush();
    out.pieces.emplace_back(std::move(variable));
  }
  flush();
}

SetNames Builder::setNames(Parser::NameStatementContext& context) {
  SetNames out;
  out.range = rangeOf(context);
  out.first = wholeNumber(context.NUMBER()->getSymbol()->getText());
  if (out.first == UINT32_MAX)
    fail<diag::SyntaxError>(rangeOf(*context.NUMBER()->getSymbol()),
                            "SETVN takes the whole number of its first variable");
  const antlr4::Token& text = *context.PRINT_TEXT()->getSymbol();
  if (!closed(text)) return out;
  const std::string spelling = text.getText();
  std::string name;
  for (std::size_t at = 1; at < spelling.size(); ++at) {
    if (spelling[at] != ',' && at + 1 != spelling.size()) {
      name += spelling[at];
      continue;
    }
    while (!name.empty() && name.back() == ' ')
      name.pop_back();
    name.erase(0, name.find_first_not_of(' '));
    out.names.push_back(std::exchange(name, {}));
  }
  return out;
}

// ---- expressions
// -----------------------------------------------------------------------------------------------------------

ExpressionPtr Builder::number(Value value, SourceRange range) {
  if (value.number) return std::move(value.number);
  fail<diag::ComparisonIsNoNumber>(value.condition ? value.condition->range : range);
  return expressionOf(range, nc::Number{"0", 0, false});
}

ConditionPtr Builder::condition(Parser::BracketContext& context) {
  Value value = bracket(context);
  if (value.condition) return std::move(value.condition);
  if (value.number && forms_.parameterBits) { // true where it is not 0
    const SourceRange range = rangeOf(context);
    auto out = std::make_unique<Condition>();
    out->range = range;
    out->brackets = std::exchange(value.number->brackets, 0);
    out->node = Comparison{"NE", std::move(value.number), expressionOf(range, nc::Number{"0", 0, false})};
    return out;
  }
  fail<diag::ConditionWithoutComparison>(rangeOf(context));
  return nullptr;
}

Builder::Value Builder::bracket(Parser::BracketContext& context) {
  Value value = comparison(*context.comparison());
  if (value.number) {
    ++value.number->brackets;
    value.number->range = rangeOf(context);
  } else if (value.condition) {
    ++value.condition->brackets;
    value.condition->range = rangeOf(context);
  }
  return value;
}

Builder::Value Builder::comparison(Parser::ComparisonContext& context) {
  Value left = sum(*context.sum(0));
  if (context.RELATION() == nullptr) return left;
  Comparison comparison;
  comparison.op = context.RELATION()->getSymbol()->getText();
  comparison.left = number(std::move(left), rangeOf(*context.sum(0)));
  comparison.right = number(sum(*context.sum(1)), rangeOf(*context.sum(1)));
  Value out;
  out.condition = std::make_unique<Condition>();
  out.condition->range = rangeOf(context);
  out.condition->node = std::move(comparison);
  return out;
}

Builder::Value Builder::joined(Value left, const std::string& op, SourceRange place, Value right) {
  const auto rangeOfValue = [](const Value& value) {
    return value.number ? value.number->range : value.condition->range;
  };
  const bool conditions = left.condition && right.condition && (op == "AND" || op == "OR" || op == "XOR");
  if (!left.number && !left.condition) return right;
  if (!right.number && !right.condition) return left;
  const SourceRange range = spanning(rangeOfValue(left), rangeOfValue(right));
  Value out;
  if (conditions) {
    out.condition = std::make_unique<Condition>();
    out.condition->range = range;
    out.condition->node = JoinedConditions{op, std::move(left.condition), std::move(right.condition)};
    return out;
  }
  ExpressionPtr first = number(std::move(left), place);
  ExpressionPtr second = number(std::move(right), place);
  out.number = expressionOf(range, nc::Operation{op, std::move(first), std::move(second)});
  return out;
}

Builder::Value Builder::sum(Parser::SumContext& context) {
  Value out;
  std::string op;
  SourceRange place;
  for (antlr4::tree::ParseTree* child : context.children) {
    if (auto* part = dynamic_cast<Parser::ProductContext*>(child)) {
      Value value = product(*part);
      out = op.empty() ? std::move(value) : joined(std::move(out), op, place, std::move(value));
    } else if (auto* terminal = dynamic_cast<antlr4::tree::TerminalNode*>(child)) {
      op = terminal->getSymbol()->getText();
      place = rangeOf(*terminal->getSymbol());
    }
  }
  return out;
}

// `ATAN[y]/[x]`: the slash belongs to the function where brackets follow it (reference, 1.5).
Builder::Value Builder::product(Parser::ProductContext& context) {
  Value out;
  std::string op;
  SourceRange place;
  for (antlr4::tree::ParseTree* child : context.children) {
    if (auto* part = dynamic_cast<Parser::FactorContext*>(child)) {
      Value value = factor(*part);
      if (op.empty()) {
        out = std::move(value);
        continue;
      }
      if (op == "/" && value.number && value.number->brackets > 0) {
        if (nc::FunctionCall* call = lastArcTangent(out.number.get(), value.number->range.end)) {
          --value.number->brackets;
          call->arguments.push_back(std::move(value.number));
          continue;
        }
      }
      out = joined(std::move(out), op, place, std::move(value));
    } else if (auto* terminal = dynamic_cast<antlr4::tree::TerminalNode*>(child)) {
      op = terminal->getSymbol()->getText();
      place = rangeOf(*terminal->getSymbol());
    }
  }
  return out;
}

Builder::Value Builder::factor(Parser::FactorContext& context) {
  Value out;
  if (auto* part = dynamic_cast<Parser::NumberFactorContext*>(&context))
    out.number = numberOf(*part->NUMBER()->getSymbol());
  else if (auto* reference = dynamic_cast<Parser::VariableFactorContext*>(&context))
    out.number = variable(*reference->variable());
  else if (auto* call = dynamic_cast<Parser::FunctionFactorContext*>(&context))
    out.number = function(*call->function());
  else if (auto* group = dynamic_cast<Parser::BracketFactorContext*>(&context))
    out = bracket(*group->bracket());
  else if (auto* with = dynamic_cast<Parser::SignedFactorContext*>(&context)) {
    out.number = number(factor(*with->factor()), rangeOf(context));
    if (with->sign()->MINUS() != nullptr)
      out.number = expressionOf(rangeOf(context), nc::Negated{std::move(out.number)});
  }
  return out;
}

ExpressionPtr Builder::numberOf(const antlr4::Token& token) {
  const std::string digits = token.getText();
  return expressionOf(rangeOf(token), nc::Number{digits, parseNumber(digits).value_or(0),
                                                 digits.find('.') != std::string::npos});
}

ExpressionPtr Builder::variable(Parser::VariableContext& context) {
  nc::VariableRef out;
  if (context.NUMBER() != nullptr) {
    const antlr4::Token& token = *context.NUMBER()->getSymbol();
    out.number = numberOf(token);
    // A parameter's number and, after the point, its bit or axis.
    const auto& number = std::get<nc::Number>(out.number->node);
    const bool bit = forms_.parameterBits && number.value >= 30000 && number.value < 31000;
    if (number.point && !bit) fail<diag::VariableNumberForm>(rangeOf(token), token.getText());
  } else {
    out.number = number(bracket(*context.bracket()), rangeOf(*context.bracket()));
  }
  return expressionOf(rangeOf(context), std::move(out));
}

ExpressionPtr Builder::function(Parser::FunctionContext& context) {
  nc::FunctionCall out;
  out.name = context.FUNCTION()->getSymbol()->getText();
  const SourceRange range = rangeOf(context);
  if (context.variable() != nullptr) {
    out.bare = true;
    out.arguments.push_back(variable(*context.variable()));
    if (out.name == "POW") fail<diag::FunctionOperands>(range, out.name, 2, 1);
    return expressionOf(range, std::move(out));
  }
  for (Parser::ComparisonContext* argument : context.comparison())
    out.arguments.push_back(number(comparison(*argument), rangeOf(*argument)));
  out.comma = out.arguments.size() == 2;
  const bool two = out.name == "POW" || (out.name == "ATAN" && out.comma);
  if (two != out.comma) fail<diag::FunctionOperands>(range, out.name, two ? 2 : 1, out.arguments.size());
  return expressionOf(range, std::move(out));
}

} // namespace dotek::frontend::macrob
