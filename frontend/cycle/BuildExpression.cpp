#include "frontend/cycle/BuildAst.h"
#include "frontend/cycle/Words.h"
#include "support/Decimal.h"
#include "support/messages/Cycle.h"

#include <charconv>

namespace dotek::frontend::cycle {
namespace {

ExpressionPtr make(SourceRange range, decltype(Expression::node) node) {
  auto out = std::make_unique<Expression>();
  out->range = range;
  out->node = std::move(node);
  return out;
}

ExpressionPtr join(BinaryOp op, ExpressionPtr left, ExpressionPtr right) {
  const SourceRange range = spanning(left->range, right->range);
  return make(range, Binary{op, std::move(left), std::move(right)});
}

// The digits with one before and one after the point, without zeros that say nothing: `05.50` keeps `5.5`.
std::string canonical(std::string_view digits) {
  std::string out(digits);
  while (out.size() > 1 && out[0] == '0' && out[1] != '.')
    out.erase(0, 1);
  if (out.starts_with('.')) out.insert(0, 1, '0');
  if (out.find('.') != std::string::npos) {
    while (out.ends_with('0'))
      out.pop_back();
    if (out.ends_with('.')) out.pop_back();
  }
  return out;
}

} // namespace

ExpressionPtr Builder::expression(Parser::ExpressionContext* context) {
  ExpressionPtr out = conjunction(*context->conjunction(0));
  for (std::size_t i = 1; i < context->conjunction().size(); ++i)
    out = join(BinaryOp::Or, std::move(out), conjunction(*context->conjunction(i)));
  return out;
}

ExpressionPtr Builder::conjunction(Parser::ConjunctionContext& context) {
  ExpressionPtr out = negation(*context.negation(0));
  for (std::size_t i = 1; i < context.negation().size(); ++i)
    out = join(BinaryOp::And, std::move(out), negation(*context.negation(i)));
  return out;
}

ExpressionPtr Builder::negation(Parser::NegationContext& context) {
  if (context.comparison() != nullptr) return comparison(*context.comparison());
  return make(rangeOf(context), Unary{UnaryOp::Not, negation(*context.negation())});
}

BinaryOp Builder::comparator(Parser::ComparatorContext& context) {
  const SourceRange range = rangeOf(context);
  const std::string text(sources_.text(range));
  switch (context.getStart()->getType()) {
  case Parser::LESS: return BinaryOp::Less;
  case Parser::LESS_EQUAL: return BinaryOp::LessEqual;
  case Parser::GREATER: return BinaryOp::Greater;
  case Parser::GREATER_EQUAL: return BinaryOp::GreaterEqual;
  case Parser::KW_IS: return context.KW_NOT() != nullptr ? BinaryOp::IsNot : BinaryOp::Is;
  default: break;
  }
  const BinaryOp meant = text == "!=" || text == "<>" ? BinaryOp::IsNot
                         : text == "=<"               ? BinaryOp::LessEqual
                         : text == "=>"               ? BinaryOp::GreaterEqual
                                                      : BinaryOp::Is;
  std::string write(operatorText(meant));
  write = write.substr(1, write.size() - 2);
  Diagnostic& found = error<diag::ForeignComparison>(range, text, write);
  found.fix = Fix{Fix::Applicability::Display, "write `" + write + "`", {{range, write}}};
  return meant;
}

ExpressionPtr Builder::comparison(Parser::ComparisonContext& context) {
  ExpressionPtr left = sum(*context.sum(0));
  if (context.comparator() == nullptr) return left;
  const BinaryOp op = comparator(*context.comparator());
  return join(op, std::move(left), sum(*context.sum(1)));
}

ExpressionPtr Builder::sum(Parser::SumContext& context) {
  ExpressionPtr out = product(*context.product(0));
  std::size_t next = 1;
  for (antlr4::tree::ParseTree* child : context.children) {
    auto* terminal = dynamic_cast<antlr4::tree::TerminalNode*>(child);
    if (terminal == nullptr) continue;
    const bool minus = terminal->getSymbol()->getType() == Parser::MINUS;
    out = join(minus ? BinaryOp::Subtract : BinaryOp::Add, std::move(out), product(*context.product(next++)));
  }
  return out;
}

ExpressionPtr Builder::product(Parser::ProductContext& context) {
  ExpressionPtr out = factor(*context.factor(0));
  std::size_t next = 1;
  for (antlr4::tree::ParseTree* child : context.children) {
    auto* terminal = dynamic_cast<antlr4::tree::TerminalNode*>(child);
    if (terminal == nullptr) continue;
    const bool slash = terminal->getSymbol()->getType() == Parser::SLASH;
    out =
        join(slash ? BinaryOp::Divide : BinaryOp::Multiply, std::move(out), factor(*context.factor(next++)));
  }
  return out;
}

ExpressionPtr Builder::factor(Parser::FactorContext& context) {
  if (context.primary() != nullptr) return primary(*context.primary());
  ExpressionPtr inner = factor(*context.factor());
  if (context.PLUS() != nullptr) return inner;
  return make(rangeOf(context), Unary{UnaryOp::Negate, std::move(inner)});
}

ExpressionPtr Builder::number(Parser::NumberContext& context) {
  const SourceRange range = rangeOf(context);
  const antlr4::Token& token = *context.getStart();
  std::string digits(sources_.text(rangeOf(token)));
  if (token.getType() == Parser::COMMA_NUMBER) {
    std::string point = digits;
    point[point.find(',')] = '.';
    Diagnostic& found = error<diag::CommaInNumber>(rangeOf(token), digits, point);
    found.fix = Fix{Fix::Applicability::Display, "write `" + point + "`", {{rangeOf(token), point}}};
    digits = point;
  }
  Number out;
  out.digits = canonical(digits);
  const std::optional<double> value = parseNumber(out.digits);
  if (!value) {
    error<diag::NumberTooLong>(range, out.digits.substr(0, 40));
    return make(range, Missing{});
  }
  out.value = *value;
  if (context.UNIT() != nullptr) out.unit = unitOf(context.UNIT()->getText()).value_or(Unit::None);
  return make(range, std::move(out));
}

ExpressionPtr Builder::workOffset(const antlr4::Token& token) {
  const SourceRange range = rangeOf(token);
  const std::string_view text = sources_.text(range);
  WorkOffset out;
  if (const std::size_t p = text.find('P'); p != std::string_view::npos) {
    const std::size_t digits = text.find_first_not_of(" \t", p + 1);
    const auto [end, failure] =
        std::from_chars(text.data() + digits, text.data() + text.size(), out.extended);
    if (failure != std::errc() || out.extended == 0 || out.extended > 300) {
      error<diag::WorkOffsetNumber>(range, std::string(text.substr(0, 40)));
      return make(range, Missing{});
    }
  } else {
    out.number = 50 + static_cast<std::uint32_t>(text[2] - '0');
  }
  return make(range, out);
}

ExpressionPtr Builder::primary(Parser::PrimaryContext& context) {
  const SourceRange range = rangeOf(context);
  if (auto* number = dynamic_cast<Parser::NumberContext*>(&context)) return this->number(*number);
  if (dynamic_cast<Parser::WorkOffsetContext*>(&context) != nullptr) return workOffset(*context.getStart());
  if (dynamic_cast<Parser::TextValueContext*>(&context) != nullptr)
    return make(range, Text{range, std::string(sources_.text({file_.file, range.begin + 1, range.end - 1}))});
  if (auto* given = dynamic_cast<Parser::GivenContext*>(&context))
    return make(range, Given{name(*given->name())});
  if (auto* function = dynamic_cast<Parser::FunctionContext*>(&context)) {
    Function out;
    const SourceRange word = rangeOf(*function->NAME()->getSymbol());
    out.name = {word, std::string(sources_.text(word))};
    for (Parser::ExpressionContext* argument : function->expression())
      out.arguments.push_back(expression(argument));
    if (isConjured(*function->RPAREN()->getSymbol())) error<diag::BracketNotClosed>(range);
    return make(range, std::move(out));
  }
  if (auto* use = dynamic_cast<Parser::NameUseContext*>(&context)) {
    const SourceRange word = rangeOf(*use->object());
    if (use->member() == nullptr) return make(range, NameUse{std::string(sources_.text(word))});
    const SourceRange member = rangeOf(*use->member());
    return make(range, Member{{word, std::string(sources_.text(word))},
                              {member, std::string(sources_.text(member))}});
  }
  auto* bracket = dynamic_cast<Parser::BracketedContext*>(&context);
  if (bracket == nullptr) return make(range, Missing{});
  if (isConjured(*bracket->RPAREN()->getSymbol()))
    error<diag::BracketNotClosed>(rangeOf(*bracket->LPAREN()->getSymbol()));
  return make(range, Bracketed{expression(bracket->expression())});
}

} // namespace dotek::frontend::cycle
