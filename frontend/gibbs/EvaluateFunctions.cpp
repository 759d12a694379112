#include "frontend/gibbs/RunMachine.h"

#include "support/Decimal.h"
#include "support/messages/Gibbs.h"

#include <cmath>

namespace dotek::frontend::gibbs {
namespace {

constexpr std::string_view kBlanks = " ";

bool isAngleFunction(std::string_view name) {
  return name == "SIN" || name == "COS" || name == "TAN" || name == "ASIN" || name == "ACOS" ||
         name == "ATAN" || name == "ANGLE_LINE";
}

std::string trimmed(std::string text, bool left, bool right) {
  if (right) text.erase(text.find_last_not_of(kBlanks) + 1);
  if (left) text.erase(0, text.find_first_not_of(kBlanks));
  return text;
}

std::string lowered(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

// A count or position: whole and not negative.
std::optional<std::size_t> wholeNumber(double value) {
  if (value < 0 || value > 1e9 || value != std::floor(value)) return std::nullopt;
  return static_cast<std::size_t>(value);
}

} // namespace

std::optional<Value> Machine::function(State& state, const FunctionCall& call, SourceRange range) {
  const std::string name = foldCase(call.name.text);
  const stdlib::FunctionSpec* spec = context_.keywords.function(name);
  const bool givesText = spec != nullptr ? spec->result == 't' : call.name.isText();
  std::vector<Value> arguments;
  for (const ExpressionPtr& argument : call.arguments) {
    const auto value = evaluate(state, *argument);
    if (!value) return std::nullopt;
    arguments.push_back(*value);
  }
  if (spec != nullptr && !spec->types.empty()) {
    if (spec->types.size() != arguments.size()) {
      fault<diag::CannotRun>(range, false, "the function takes another number of values");
      return std::nullopt;
    }
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const bool wantsText = spec->types[i] == 't';
      if (isTextValue(arguments[i]) == wantsText) continue;
      fault<diag::KindMismatchRun>(call.arguments[i]->range, false, wantsText ? "a number" : "a text",
                                   wantsText ? "a text" : "a number");
      return std::nullopt;
    }
  }
  if (isAngleFunction(name) && !state.angles) {
    const bool degrees = context_.assumptions.contains("angle-degrees");
    if (degrees == context_.assumptions.contains("angle-radians")) {
      fault<diag::AngleUnitOpen>(call.name.range, false, call.name.text);
      return std::nullopt;
    }
    state.angles = degrees ? ir::AngleUnit::Degrees : ir::AngleUnit::Radians;
  }
  bool allKnown = true;
  for (const Value& value : arguments)
    allKnown = allKnown && unknownIn(value) == nullptr;
  if (allKnown) {
    bool known = true;
    auto result = givesText ? textFunction(name, arguments, range, known)
                            : numberFunction(state, name, arguments, range, known);
    if (known) return result;
  }
  std::string symbol = name + "(";
  for (const Value& value : arguments)
    symbol += canonical(value) + ",";
  if (isAngleFunction(name)) symbol += *state.angles == ir::AngleUnit::Degrees ? "degrees" : "radians";
  std::string reason = call.name.text;
  for (const Value& value : arguments) {
    if (const Unknown* unknown = unknownIn(value)) reason = unknown->reason;
  }
  return opaque(state, symbol + ")", arguments, reason, givesText);
}

std::optional<Value> Machine::numberFunction(State& state, const std::string& name,
                                             const std::vector<Value>& arguments, SourceRange range,
                                             bool& known) {
  if (arguments.empty()) {
    known = false;
    return std::nullopt;
  }
  if (const std::string* text = std::get_if<std::string>(&arguments[0])) {
    if (name == "LEN") return Value(static_cast<double>(text->size()));
    if (name == "ASC") {
      if (text->size() == 1) return Value(static_cast<double>(static_cast<unsigned char>((*text)[0])));
      fault<diag::DomainError>(range, true, "a text that is not one character long");
      return std::nullopt;
    }
    if (name == "VAL") {
      if (const auto number = parseNumber(trimmed(*text, true, true))) return Value(*number);
      fault<diag::DomainError>(range, true, "a text that is no number");
      return std::nullopt;
    }
    known = false;
    return std::nullopt;
  }
  const double a = std::get<double>(arguments[0]);
  const ir::AngleUnit unit = state.angles.value_or(ir::AngleUnit::Degrees);
  if (name == "ABS") return computed(ir::absolute(a), range);
  if (name == "INT") return computed(ir::truncate(a), range);
  if (name == "SQRT") return computed(ir::squareRoot(a), range);
  if (name == "SIN") return computed(ir::sine(a, unit), range);
  if (name == "COS") return computed(ir::cosine(a, unit), range);
  if (name == "TAN") return computed(ir::tangent(a, unit), range);
  if (name == "ASIN") return computed(ir::arcSine(a, unit), range);
  if (name == "ACOS") return computed(ir::arcCosine(a, unit), range);
  if (name == "ATAN") return computed(ir::arcTangent(a, unit), range);
  if (name == "ANGLE_LINE" && arguments.size() == 2 && std::holds_alternative<double>(arguments[1])) {
    return computed(ir::direction(a, std::get<double>(arguments[1]), unit), range);
  }
  known = false;
  return std::nullopt;
}

std::optional<Value> Machine::textFunction(const std::string& name, const std::vector<Value>& arguments,
                                           SourceRange range, bool& known) {
  if (name == "CHR$" && arguments.size() == 1 && std::holds_alternative<double>(arguments[0])) {
    const auto code = wholeNumber(std::get<double>(arguments[0]));
    if (code && *code > 0 && *code <= 255) return Value(std::string(1, static_cast<char>(*code)));
    fault<diag::DomainError>(range, true, "a code that no character has");
    return std::nullopt;
  }
  const std::string* text = arguments.empty() ? nullptr : std::get_if<std::string>(&arguments[0]);
  if (text != nullptr && arguments.size() == 1) {
    if (name == "LTRIM$") return Value(trimmed(*text, true, false));
    if (name == "RTRIM$") return Value(trimmed(*text, false, true));
    if (name == "TRIM$") return Value(trimmed(*text, true, true));
    if (name == "LCASE$") return Value(lowered(*text));
    if (name == "UCASE$") return Value(foldCase(*text));
  }
  if (text != nullptr && arguments.size() >= 2 && (name == "LEFT$" || name == "RIGHT$" || name == "MID$")) {
    const double* a = std::get_if<double>(&arguments[1]);
    const double* b = std::get_if<double>(&arguments.back());
    const auto first = a != nullptr ? wholeNumber(*a) : std::nullopt;
    const auto count = b != nullptr ? wholeNumber(*b) : std::nullopt;
    if (!first || !count || (name == "MID$" && *first == 0)) {
      fault<diag::DomainError>(range, true, "a number of characters that no text has");
      return std::nullopt;
    }
    if (name == "LEFT$") return Value(text->substr(0, *first));
    if (name == "RIGHT$") return Value(text->substr(text->size() - std::min(text->size(), *first)));
    return Value(*first > text->size() ? std::string() : text->substr(*first - 1, *count));
  }
  known = false;
  return std::nullopt;
}

} // namespace dotek::frontend::gibbs
