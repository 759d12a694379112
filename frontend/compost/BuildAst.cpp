// Parse trees of the generated parser to the syntax tree; what the grammar takes and the language does not
// is reported here.
#include "frontend/compost/BuildAst.h"
#include "support/messages/ComPost.h"
#include "support/messages/Common.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>

namespace dotek::frontend::compost {

using Parser = grammar::ComPostParser;

namespace {

// Keyword tokens may carry a colon, which is reported apart.
SourceRange withoutColon(SourceRange range, const SourceMap& sources) {
  if (sources.text(range).ends_with(':')) --range.end;
  return range;
}

} // namespace

// ---- reporting -------------------------------------------------------------------------------------------

std::uint32_t Builder::lineOf(SourceRange range) const {
  return source_.lineOf(range.begin);
}

// Stray tokens on a line that has an error already are its consequences.
bool Builder::quiet(SourceRange range) const {
  const std::uint32_t line = lineOf(range);
  return line == errorLine_ || findings_.typographicLines.contains(line);
}

void Builder::syntaxError(SourceRange range, std::string message) {
  program_.hasErrorNodes = true;
  if (findings_.typographicLines.contains(lineOf(range))) return;
  errorLine_ = lineOf(range);
  diagnostics_.report<diag::SyntaxError>(range, message);
}

SourceRange Builder::keyword(const antlr4::Token& token) {
  const SourceRange range = rangeOf(token);
  const SourceRange word = withoutColon(range, sources_);
  if (word != range)
    syntaxError({file_, word.end, range.end},
                fmt::format("a colon follows `{0}`, where only the name of a routine has one; write `{0}`",
                            sources_.textUtf8(word)));
  return word;
}

// ---- words -----------------------------------------------------------------------------------------------

Word Builder::word(Parser::WordContext& context) {
  Word result;
  result.range = rangeOf(context);
  const antlr4::Token& name = *context.getStart();
  result.nameRange = rangeOf(name);
  result.name = sources_.text(result.nameRange);
  if (name.getType() != Parser::NAME) {
    result.kind = name.getType() == Parser::NUMERIC ? WordKind::Numeric : WordKind::Boolean;
    result.name.pop_back();
  }
  if (context.arguments() != nullptr) result.arguments = arguments(*context.arguments());
  return result;
}

std::vector<Literal> Builder::arguments(Parser::ArgumentsContext& context) {
  std::vector<Literal> result;
  const SourceRange bracket = rangeOf(*context.getStart());
  bool expectArgument = true;
  bool closed = true;
  bool unterminated = false;
  for (antlr4::tree::ParseTree* child : context.children) {
    if (auto* part = dynamic_cast<Parser::ArgumentContext*>(child)) {
      expectArgument = false;
      if (const std::optional<Literal> literal = argument(*part, unterminated)) result.push_back(*literal);
      continue;
    }
    auto* terminal = dynamic_cast<antlr4::tree::TerminalNode*>(child);
    if (terminal == nullptr) continue;
    const antlr4::Token& token = *terminal->getSymbol();
    if (token.getType() == Parser::RPAREN && isConjured(token)) closed = false;
    const bool endsArgument = token.getType() == Parser::COMMA || token.getType() == Parser::RPAREN;
    if (endsArgument && !isConjured(token)) {
      if (expectArgument && !quiet(rangeOf(token)))
        syntaxError(rangeOf(token), "an argument is missing here; write a value in apostrophes, `('NAME')`");
      expectArgument = true;
    }
  }
  if (!closed) {
    program_.hasErrorNodes = true;
    if (!unterminated && !quiet(bracket) && !cutShort(rangeOf(context)))
      syntaxError(bracket, "the bracket that opens here is not closed; write `)` after the argument");
  }
  return result;
}

std::optional<Literal> Builder::argument(Parser::ArgumentContext& context, bool& unterminated) {
  const SourceRange range = rangeOf(context);
  const SourceRange inner{file_, range.begin + 1, range.end - 1};
  if (dynamic_cast<Parser::TextArgumentContext*>(&context) != nullptr)
    return Literal{range, std::string(sources_.text(inner))};
  program_.hasErrorNodes = true;
  if (dynamic_cast<Parser::BrokenArgumentContext*>(&context) != nullptr) {
    unterminated = true; // reported with the tokens
    return std::nullopt;
  }
  if (!quiet(range) && !cutShort(range)) {
    const std::string text = sources_.textUtf8(range);
    if (text.find_first_of("()'\r\n") == std::string::npos && text.size() <= 40)
      syntaxError(range, fmt::format("the argument `{0}` is without apostrophes; write `('{0}')`", text));
    else
      syntaxError(rangeOf(*context.getStart()),
                  "the argument that begins here is without apostrophes; write `('NAME')`");
  }
  return Literal{range, std::string(sources_.text(range))};
}

// ---- conditions ------------------------------------------------------------------------------------------

Condition Builder::condition(Parser::ConditionContext& context, SourceRange before) {
  Condition result;
  result.range = rangeOf(context);
  const std::vector<Parser::ConnectiveContext*> connectives = context.connective();
  const std::vector<Parser::TermContext*> terms = context.term();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (i > 0) {
      before = rangeOf(*connectives[i - 1]);
      result.connectives.push_back(connectives[i - 1]->KW_AND() != nullptr ? Connective::And
                                                                           : Connective::Or);
    }
    result.terms.push_back(term(*terms[i], before));
  }
  return result;
}

ConditionTerm Builder::term(Parser::TermContext& context, SourceRange before) {
  ConditionTerm result;
  result.range = rangeOf(context);
  for (antlr4::tree::TerminalNode* node : context.KW_NOT()) {
    before = rangeOf(*node->getSymbol());
    result.nots.push_back(before);
  }
  if (auto* operand = dynamic_cast<Parser::WordOperandContext*>(context.operand())) {
    Word test = word(*operand->word());
    if (test.kind != WordKind::Boolean) {
      program_.hasErrorNodes = true;
      if (!quiet(test.nameRange)) {
        errorLine_ = lineOf(test.nameRange);
        diagnostics_.report<diag::ConditionNotBoolean>(test.nameRange, sources_.textUtf8(test.nameRange),
                                                       test.name);
      }
    }
    result.operand = std::move(test);
  } else if (auto* bracket = dynamic_cast<Parser::BracketOperandContext*>(context.operand())) {
    const SourceRange open = rangeOf(*bracket->LPAREN()->getSymbol());
    result.operand = std::make_unique<Condition>(condition(*bracket->condition(), open));
    if (isConjured(*bracket->RPAREN()->getSymbol()) && !quiet(open) && !cutShort(rangeOf(*bracket)))
      syntaxError(open, "the bracket that opens here is not closed; write `)` after the condition");
  } else {
    result.range = result.nots.empty() ? SourceRange{file_, before.end, before.end} : result.range;
    result.operand = ConditionError{};
    if (!quiet(before) && !cutShort(before))
      syntaxError(before,
                  fmt::format("no condition follows `{}`; write a boolean keyword such as `Flag?('NAME')`",
                              sources_.textUtf8(withoutColon(before, sources_))));
    program_.hasErrorNodes = true;
  }
  return result;
}

// ---- statements ------------------------------------------------------------------------------------------

void Builder::append(std::vector<Statement>& body, SourceRange stray) {
  program_.hasErrorNodes = true;
  if (!body.empty()) {
    auto* last = std::get_if<ErrorStatement>(&body.back());
    if (last != nullptr && lineOf(last->range) == lineOf(stray)) {
      last->range = spanning(last->range, stray);
      return;
    }
  }
  body.push_back(ErrorStatement{stray});
}

void Builder::strayToken(const antlr4::Token& token) {
  const SourceRange range = rangeOf(token);
  program_.hasErrorNodes = true;
  const std::size_t type = token.getType();
  if (type == Parser::UNTERMINATED_LITERAL || type == Parser::TYPOGRAPHIC_TEXT ||
      type == Parser::TYPOGRAPHIC_QUOTE)
    return;
  if (quiet(range)) return;
  const std::string text = sources_.textUtf8(range);
  switch (type) {
  case Parser::STRAY_LPAREN:
    return syntaxError(range, "a bracket opens here, where no keyword that takes an argument is before it");
  case Parser::RPAREN: return syntaxError(range, "this bracket closes nothing; take it out");
  case Parser::COMMA: return syntaxError(range, "a comma has no meaning between statements; take it out");
  case Parser::EQUALS:
    return syntaxError(range, "`=` has a meaning in the definition of a picture only, `#10 = '###.##'`");
  case Parser::COLON:
    return syntaxError(range, "a colon is alone; the label of a routine is its name with the colon "
                              "directly after it, `name:`");
  case Parser::INTEGER:
    return syntaxError(
        range,
        fmt::format("the number `{0}` is no statement; what the NC program shall hold is in apostrophes, "
                    "`'{0}'`",
                    text));
  default: break;
  }
  errorLine_ = lineOf(range);
  if (text == "}") {
    diagnostics_.report<diag::UnexpectedCharacter>(range, "`}`, which closes no comment,");
    return;
  }
  const auto byte = static_cast<unsigned char>(sources_.text(range).front());
  const bool printable = byte > 0x20 && byte != 0x7F && text != "\xEF\xBF\xBD" && text != "\xC2\xA0";
  diagnostics_.report<diag::UnexpectedCharacter>(
      range, printable            ? fmt::format("`{}`", text)
             : text == "\xC2\xA0" ? std::string("no-break space (a copy from a web page or a PDF)")
                                  : fmt::format("with the code {}", byte));
}

void Builder::dangling(Parser::DanglingTermContext& context, std::vector<Statement>& body) {
  const SourceRange first = rangeOf(*context.connective());
  if (!quiet(first))
    syntaxError(
        first, fmt::format("`{}` joins conditions, and no condition is before it", sources_.textUtf8(first)));
  append(body, rangeOf(context));
}

void Builder::strayFlow(Parser::StrayFlowContext& context, std::vector<Statement>& body) {
  const SourceRange range = keyword(*context.getStart());
  program_.hasErrorNodes = true;
  if (!quiet(range) && !losesText(range)) {
    errorLine_ = lineOf(range);
    if (context.KW_ELSE() != nullptr)
      diagnostics_.report<diag::ElseWithoutIf>(
          range, "none is open here; take it out, or write the `IF` it belongs to");
    else
      diagnostics_.report<diag::EndWithoutIf>(range);
  }
  append(body, range);
  for (Parser::DanglingTermContext* part : context.danglingTerm())
    dangling(*part, body);
}

void Builder::entry(Parser::EntryContext& context, std::vector<Statement>& body) {
  if (context.statement() != nullptr)
    statement(*context.statement(), body);
  else
    directive(*context.directive(), true);
  for (Parser::DanglingTermContext* part : context.danglingTerm())
    dangling(*part, body);
}

void Builder::statement(Parser::StatementContext& context, std::vector<Statement>& body) {
  const SourceRange range = rangeOf(context);
  if (dynamic_cast<Parser::LiteralStatementContext*>(&context) != nullptr) {
    body.push_back(Literal{range, std::string(sources_.text({file_, range.begin + 1, range.end - 1}))});
  } else if (dynamic_cast<Parser::EndOfLineContext*>(&context) != nullptr) {
    body.push_back(EndOfLine{keyword(*context.getStart())});
  } else if (auto* call = dynamic_cast<Parser::WordStatementContext*>(&context)) {
    body.push_back(word(*call->word()));
  } else if (auto* branch = dynamic_cast<Parser::ConditionalContext*>(&context)) {
    body.push_back(conditional(*branch->ifStatement()));
  } else if (auto* stray = dynamic_cast<Parser::StrayStatementContext*>(&context)) {
    if (auto* one = dynamic_cast<Parser::StrayOneContext*>(stray->stray())) {
      strayToken(*one->getStart());
    } else {
      const SourceRange first = rangeOf(*context.getStart());
      if (!quiet(first)) syntaxError(first, "`NOT` belongs to a condition, and no `IF` is before it");
    }
    append(body, range);
  }
}

std::unique_ptr<If> Builder::conditional(Parser::IfStatementContext& context) {
  auto result = std::make_unique<If>();
  result->ifRange = keyword(*context.KW_IF()->getSymbol());
  result->range = rangeOf(context);
  result->condition = condition(*context.condition(), result->ifRange);
  for (Parser::EntryContext* part : context.block()->entry())
    entry(*part, result->thenBody);
  for (Parser::ElsePartContext* part : context.elsePart()) {
    const SourceRange range = keyword(*part->KW_ELSE()->getSymbol());
    if (result->elseRange) {
      if (!quiet(range)) {
        errorLine_ = lineOf(range);
        diagnostics_
            .report<diag::ElseWithoutIf>(
                range, "its `IF` has an `ELSE` already; close that with `END`, or take one out")
            .note(*result->elseRange, "the first `ELSE`");
      }
      append(result->elseBody, range);
    } else {
      result->elseRange = range;
    }
    for (Parser::DanglingTermContext* term : part->danglingTerm())
      dangling(*term, result->elseBody);
    for (Parser::EntryContext* inner : part->block()->entry())
      entry(*inner, result->elseBody);
  }
  const antlr4::Token* end = context.KW_END() == nullptr ? nullptr : context.KW_END()->getSymbol();
  if (end == nullptr || isConjured(*end))
    openIfs_.push_back(result.get());
  else
    result->endRange = keyword(*end);
  return result;
}

// ---- directives ------------------------------------------------------------------------------------------

std::optional<std::uint32_t> Builder::pictureNumber(SourceRange range) {
  std::string_view digits = sources_.text(range);
  digits.remove_prefix(std::min(digits.find_first_of("0123456789"), digits.size()));
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size() || digits.empty()) {
    if (!quiet(range))
      syntaxError(range, fmt::format("`{}` is no number of a picture", sources_.textUtf8(range)));
    return std::nullopt;
  }
  return number;
}

void Builder::directive(Parser::DirectiveContext& context, bool inRoutine) {
  const SourceRange range = rangeOf(context);
  const std::size_t errorsBefore = diagnostics_.all().size();
  std::optional<Item> item;
  if (auto* picture = dynamic_cast<Parser::PictureDefinitionContext*>(&context)) {
    item = pictureDefinition(*picture, range);
  } else if (auto* format = dynamic_cast<Parser::FormatDirectiveContext*>(&context)) {
    item = formatDirective(*format, range);
  }
  if (!item) {
    program_.hasErrorNodes = true;
    item = ErrorItem{range};
  }
  if (inRoutine) {
    innerDirectives_.push_back(std::move(*item));
    if (errorsBefore == diagnostics_.all().size()) lastDirective_ = range;
  } else {
    program_.items.push_back(std::move(*item));
  }
}

std::optional<Item> Builder::pictureDefinition(Parser::PictureDefinitionContext& context, SourceRange range) {
  PictureDefinition result;
  result.range = range;
  result.numberRange = rangeOf(*context.PICTURE_NUMBER()->getSymbol());
  const std::optional<std::uint32_t> number = pictureNumber(result.numberRange);
  if (!number) return std::nullopt;
  result.number = *number;
  if (isConjured(*context.EQUALS()->getSymbol()) && !quiet(result.numberRange))
    syntaxError(result.numberRange, "no `=` follows the number of the picture; write `#10 = '###.##'`");
  if (context.pictureText()->LITERAL() == nullptr) {
    if (context.pictureText()->exception != nullptr && !quiet(result.numberRange))
      syntaxError(result.numberRange, "no picture follows; write it in apostrophes, `#10 = '###.##'`");
    return std::nullopt;
  }
  if (isConjured(*context.EQUALS()->getSymbol())) return std::nullopt;
  const SourceRange text = rangeOf(*context.pictureText());
  result.picture = {text, std::string(sources_.text({file_, text.begin + 1, text.end - 1}))};
  return result;
}

std::optional<Item> Builder::formatDirective(Parser::FormatDirectiveContext& context, SourceRange range) {
  FormatDirective result;
  result.range = range;
  const SourceRange head = keyword(*context.KW_FORMAT()->getSymbol());
  const auto refuse = [&](SourceRange where, std::string message) -> std::optional<Item> {
    if (!quiet(where)) syntaxError(where, std::move(message));
    return std::nullopt;
  };
  const std::string_view usage =
      "write `FORMAT(KEYWORD#,10)`, a numeric keyword and the number of a picture, without apostrophes";
  if (context.arguments() == nullptr)
    return refuse(head, fmt::format("`FORMAT` has no arguments; {}", usage));
  const std::vector<Parser::ArgumentContext*> given = context.arguments()->argument();
  if (given.size() != 2)
    return refuse(head, fmt::format("`FORMAT` has {} arguments; {}", given.size(), usage));
  // One plain token each.
  const auto plain = [&](Parser::ArgumentContext& part) -> const antlr4::Token* {
    auto* bare = dynamic_cast<Parser::BareArgumentContext*>(&part);
    if (bare == nullptr || bare->unquoted().size() != 1 || bare->unquoted(0)->arguments() != nullptr)
      return nullptr;
    return bare->getStart();
  };
  const antlr4::Token* name = plain(*given[0]);
  if (name == nullptr || (name->getType() != Parser::NAME && name->getType() != Parser::NUMERIC &&
                          name->getType() != Parser::BOOLEAN))
    return refuse(rangeOf(*given[0]),
                  fmt::format("`{}` is no keyword; {}", sources_.textUtf8(rangeOf(*given[0])), usage));
  const antlr4::Token* number = plain(*given[1]);
  if (number == nullptr || number->getType() != Parser::INTEGER)
    return refuse(rangeOf(*given[1]), fmt::format("`{}` is no number of a picture; {}",
                                                  sources_.textUtf8(rangeOf(*given[1])), usage));
  if (isConjured(*context.arguments()->RPAREN()->getSymbol()))
    return refuse(rangeOf(*context.arguments()->getStart()),
                  fmt::format("the bracket that opens here is not closed; {}", usage));
  if (context.arguments()->COMMA().size() != 1)
    return refuse(head, fmt::format("`FORMAT` has an empty argument; {}", usage));
  result.nameRange = rangeOf(*name);
  result.name = sources_.text(result.nameRange);
  result.kind = name->getType() == Parser::NUMERIC   ? WordKind::Numeric
                : name->getType() == Parser::BOOLEAN ? WordKind::Boolean
                                                     : WordKind::Command;
  if (result.kind != WordKind::Command) result.name.pop_back();
  result.numberRange = rangeOf(*number);
  const std::optional<std::uint32_t> value = pictureNumber(result.numberRange);
  if (!value) return std::nullopt;
  result.number = *value;
  return result;
}

} // namespace dotek::frontend::compost
