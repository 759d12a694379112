#include "frontend/gibbs/Functions.h"

#include "support/Decimal.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dotek::frontend::gibbs {
namespace {

using Angle = NumberFunction::Angle;
using Unit = ir::AngleUnit;

constexpr std::array<NumberFunction, 10> kNumberFunctions{{
    {"ABS", ir::UnaryOp::Absolute, Angle::None, false,
     [](double a, double, Unit) { return ir::absolute(a); }},
    {"INT", ir::UnaryOp::Truncate, Angle::None, false,
     [](double a, double, Unit) { return ir::truncate(a); }},
    {"SQRT", ir::UnaryOp::SquareRoot, Angle::None, true,
     [](double a, double, Unit) { return ir::squareRoot(a); }},
    {"SIN", ir::UnaryOp::Sine, Angle::Argument, false,
     [](double a, double, Unit unit) { return ir::sine(a, unit); }},
    {"COS", ir::UnaryOp::Cosine, Angle::Argument, false,
     [](double a, double, Unit unit) { return ir::cosine(a, unit); }},
    {"TAN", ir::UnaryOp::Tangent, Angle::Argument, true,
     [](double a, double, Unit unit) { return ir::tangent(a, unit); }},
    {"ASIN", ir::UnaryOp::ArcSine, Angle::Result, true,
     [](double a, double, Unit unit) { return ir::arcSine(a, unit); }},
    {"ACOS", ir::UnaryOp::ArcCosine, Angle::Result, true,
     [](double a, double, Unit unit) { return ir::arcCosine(a, unit); }},
    {"ATAN", ir::UnaryOp::ArcTangent, Angle::Result, false,
     [](double a, double, Unit unit) { return ir::arcTangent(a, unit); }},
    {"ANGLE_LINE", ir::BinaryOp::Direction, Angle::Result, true,
     [](double a, double b, Unit unit) { return ir::direction(a, b, unit); }},
}};

std::string trimmed(std::string text, bool left, bool right) {
  constexpr std::string_view kBlanks = " ";
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
std::optional<std::size_t> wholeNumber(const Value& value) {
  const double* number = numberIn(value);
  if (number == nullptr || *number < 0 || *number > 1e9 || *number != std::floor(*number))
    return std::nullopt;
  return static_cast<std::size_t>(*number);
}

TextResult partOf(std::string_view name, const std::string& text, const std::vector<Value>& arguments) {
  const auto first = wholeNumber(arguments[1]);
  const auto count = wholeNumber(arguments.back());
  if (!first || !count || (name == "MID$" && *first == 0))
    return {{}, "a number of characters that no text has"};
  if (name == "LEFT$") return {text.substr(0, *first), {}};
  if (name == "RIGHT$") return {text.substr(text.size() - std::min(text.size(), *first)), {}};
  return {*first > text.size() ? std::string() : text.substr(*first - 1, *count), {}};
}

} // namespace

ir::BinaryOp irOperator(BinaryOperator op) {
  switch (op) {
  case BinaryOperator::Add: return ir::BinaryOp::Add;
  case BinaryOperator::Subtract: return ir::BinaryOp::Subtract;
  case BinaryOperator::Multiply: return ir::BinaryOp::Multiply;
  case BinaryOperator::Divide: return ir::BinaryOp::Divide;
  }
  return ir::BinaryOp::Add;
}

const NumberFunction kNegation = {"-", ir::UnaryOp::Negate, Angle::None, false,
                                  [](double a, double, Unit) { return ir::subtract(0, a); }};

const NumberFunction* numberFunction(std::string_view name) {
  const auto found = std::find_if(kNumberFunctions.begin(), kNumberFunctions.end(),
                                  [&](const NumberFunction& each) { return each.name == name; });
  return found == kNumberFunctions.end() ? nullptr : &*found;
}

TextResult textFunction(std::string_view name, const std::vector<Value>& arguments) {
  const auto known = [](const Value& value) {
    return std::holds_alternative<std::string>(value) || numberIn(value) != nullptr;
  };
  if (arguments.empty() || !std::all_of(arguments.begin(), arguments.end(), known)) return {};
  const auto* text = std::get_if<std::string>(&arguments[0]);
  if (text == nullptr) {
    if (name != "CHR$" || arguments.size() != 1) return {};
    const auto code = wholeNumber(arguments[0]);
    if (!code || *code == 0 || *code > 255) return {{}, "a code that no character has"};
    return {std::string(1, static_cast<char>(*code)), {}};
  }
  if (name == "LEN") return {static_cast<double>(text->size()), {}};
  if (name == "ASC") {
    if (text->size() != 1) return {{}, "a text that is not one character long"};
    return {static_cast<double>(static_cast<unsigned char>((*text)[0])), {}};
  }
  if (name == "VAL") {
    if (const auto number = parseNumber(trimmed(*text, true, true))) return {*number, {}};
    return {{}, "a text that is no number"};
  }
  if (name == "LTRIM$") return {trimmed(*text, true, false), {}};
  if (name == "RTRIM$") return {trimmed(*text, false, true), {}};
  if (name == "TRIM$") return {trimmed(*text, true, true), {}};
  if (name == "LCASE$") return {lowered(*text), {}};
  if (name == "UCASE$") return {foldCase(*text), {}};
  const bool part = name == "LEFT$" || name == "RIGHT$" || name == "MID$";
  return part && arguments.size() >= 2 ? partOf(name, *text, arguments) : TextResult{};
}

} // namespace dotek::frontend::gibbs
