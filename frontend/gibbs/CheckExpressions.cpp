// Texts and numbers, long texts, and constructs that no source confirms.
#include "frontend/gibbs/Check.h"
#include "frontend/gibbs/Unverified.h"
#include "frontend/gibbs/Walk.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

namespace {

std::size_t characters(const std::string& bytes, const CheckedFile& input) {
  if (input.sources.file(input.file).encoding() != Encoding::Utf8) return bytes.size();
  return static_cast<std::size_t>(std::count_if(
      bytes.begin(), bytes.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// Length of a text where it is more than a variable holds.
std::optional<std::size_t> tooLong(const Expression& expression, const CheckedFile& input) {
  const auto* literal = std::get_if<TextLiteral>(&expression.node);
  if (literal == nullptr || literal->text.size() <= input.limits.textLength) return std::nullopt;
  const std::size_t length = characters(literal->text, input);
  return length > input.limits.textLength ? std::optional(length) : std::nullopt;
}

bool isText(const Expression& expression, const CheckedFile& input) {
  return typeOf(expression, input.keywords) == ValueType::Text;
}

// What an operator does with a text; "" where nothing is wrong.
std::string_view mixes(const Expression& expression, const CheckedFile& input) {
  if (const auto* unary = std::get_if<Unary>(&expression.node))
    return isText(*unary->operand, input) ? "a sign is before a text" : "";
  const auto* binary = std::get_if<Binary>(&expression.node);
  if (binary == nullptr) return "";
  // The left side of a chain is judged at its own link.
  const bool leftIsLink = std::holds_alternative<Binary>(binary->left->node);
  const bool left = !leftIsLink && isText(*binary->left, input);
  const bool right = isText(*binary->right, input);
  const bool mixed = !leftIsLink && left != right;
  const bool wrong = (binary->op != BinaryOperator::Add && (left || right)) || mixed;
  return wrong ? "a text and a number are computed with one another" : "";
}

bool argumentsFit(const FunctionCall& call, const CheckedFile& input) {
  const stdlib::FunctionSpec* spec = input.keywords.function(call.name.text);
  if (spec == nullptr || spec->open) return true;
  if (call.arguments.size() != spec->types.size()) return false;
  for (std::size_t i = 0; i < call.arguments.size(); ++i)
    if (isText(*call.arguments[i], input) != (spec->types[i] == 't')) return false;
  return true;
}

} // namespace

bool CheckedFile::isWrong(const Expression& expression) const {
  const auto* call = std::get_if<FunctionCall>(&expression.node);
  return isUnknownFunction(expression) || tooLong(expression, *this) || !mixes(expression, *this).empty() ||
         (call != nullptr && !argumentsFit(*call, *this));
}

void textAndNumber(const CheckedFile& input, Report& report) {
  const auto tell = [&](SourceRange range, std::string_view fact) {
    report.at(range, "{}; GibbsCAM keeps texts in names that end in `$` only", fact);
  };
  for (const Expression* expression : input.expressions)
    if (const std::string_view fact = mixes(*expression, input); !fact.empty()) tell(expression->range, fact);
  for (const Statement* statement : input.statements) {
    if (const auto* assign = std::get_if<Assignment>(&statement->node)) {
      const bool text = isText(*assign->value, input);
      if (text == assign->target.name.isText()) continue;
      bool wrong = false; // then the value has its own finding
      ownExpressions(*statement, [&](const Expression& own) {
        walkExpression(own, [&](const Expression& each) { wrong = wrong || input.isWrong(each); });
      });
      if (!wrong)
        tell(assign->value->range,
             text ? "a text is assigned to the number `" + assign->target.name.text + "`"
                  : "a number is assigned to the text `" + assign->target.name.text + "`");
    } else if (const auto* branch = std::get_if<If>(&statement->node)) {
      for (const Comparison& comparison : branch->condition.comparisons)
        if (isText(*comparison.left, input) != isText(*comparison.right, input))
          tell(comparison.range, "a text is compared with a number");
    } else if (const auto* loop = std::get_if<For>(&statement->node)) {
      for (const ExpressionPtr* bound : {&loop->from, &loop->to, &loop->step})
        if (*bound != nullptr && isText(**bound, input))
          tell((*bound)->range, "FOR counts with numbers, and this is a text");
    }
  }
}

void textTooLong(const CheckedFile& input, Report& report) {
  for (const Expression* expression : input.expressions)
    if (const auto length = tooLong(*expression, input))
      report.at(expression->range, "the text has {} characters; a text variable holds {}", *length,
                input.limits.textLength);
}

void commaBeforeThen(const CheckedFile& input, Report& report) {
  for (const Statement* statement : input.statements)
    if (const auto* branch = std::get_if<If>(&statement->node); branch != nullptr && branch->commaBeforeThen)
      report.at(*branch->commaBeforeThen,
                "comma before THEN; GibbsCAM has been seen to accept it; leave it out");
}

void unverifiedConstruct(const CheckedFile& input, Report& report) {
  std::set<std::string_view> noted; // one finding for each construct
  const auto note = [&](const Unverified& found) {
    if (!noted.insert(found.assumption).second) return;
    const Assumption* assumption = findAssumption(found.assumption);
    report.at(found.range,
              "{} is unverified: no source shows it; Dotek reads it so: {}; a run that depends on it needs "
              "`--assume {}`",
              assumption->construct, assumption->reading, assumption->id);
  };
  const auto own = [&](const Expression& expression) {
    for (const Unverified& found : unverifiedIn(expression, input.keywords))
      if (found.assumption != "loose-caption") note(found);
  };
  for (const Statement* statement : input.statements)
    for (const Unverified& found : unverifiedIn(*statement, input.keywords))
      note(found);
  for (const SourceRange& range : input.flow.intoFor)
    note({"goto-into-for", range});
  if (input.dialog != nullptr)
    for (const Control& control : input.dialog->controls)
      for (const ExpressionPtr& argument : control.arguments)
        own(*argument);
  if (input.defines != nullptr)
    for (const Definition& definition : input.defines->definitions)
      own(*definition.value);
}

} // namespace dotek::frontend::gibbs
