#include "frontend/nc/BlockParser.h"

#include "support/Decimal.h"
#include "support/messages/Common.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::nc {
namespace {

constexpr std::size_t kMostDigits = 8;

// Longer names before those that they begin with.
constexpr std::array<std::string_view, 17> kFunctions = {"ASIN", "ACOS",  "ATAN", "SIN", "COS", "TAN",
                                                         "SQRT", "ROUND", "ABS",  "FIX", "FUP", "LN",
                                                         "EXP",  "POW",   "BIN",  "BCD", "ADP"};

} // namespace

ExpressionPtr BlockParser::make(std::size_t begin, decltype(Expression::node) node) const {
  return std::make_unique<Expression>(Expression{in_.range(begin, in_.position()), std::move(node)});
}

std::string BlockParser::shown(std::size_t begin, std::size_t end) const {
  return "`" + std::string(in_.text(begin, end)) + "`";
}

Refused BlockParser::unexpected() {
  const char c = in_.peek();
  if (c == Reader::kEnd) return syntax(in_.here(), "the block ends in the middle of an expression");
  if (c == Reader::kHole)
    return syntax(in_.here(), "{} is printed where no number may appear", in_.hole().hole.name);
  const std::string text = c >= ' ' && c <= '~' ? shown(in_.position(), in_.position() + 1)
                                                : fmt::format("with code {}", static_cast<unsigned char>(c));
  diagnostics_.report<diag::UnexpectedCharacter>(in_.here(), text);
  return {};
}

bool BlockParser::enter() {
  if (++depth_ <= limits_.nesting) return true;
  diagnostics_.report<diag::NestingTooDeep>(in_.here(), limits_.nesting);
  return false;
}

// A long chain of operators is a deep tree.
bool BlockParser::count() {
  if (++operators_ <= limits_.lineTokens) return true;
  diagnostics_.report<diag::TooManyTokens>(in_.here(), limits_.lineTokens);
  return false;
}

void BlockParser::warnOfSign(char sign, std::size_t at) {
  diagnostics_.report<diag::SignBeforeValue>(in_.range(at, at + 1), in_.hole().hole.name, sign);
}

// The operator here, read; "" for none.
std::string_view BlockParser::operatorHere(std::initializer_list<std::string_view> operators) {
  in_.skipBlanks();
  for (const std::string_view one : operators) {
    if (!in_.startsWith(one)) continue;
    in_.skip(one.size());
    return one;
  }
  return "";
}

ExpressionPtr BlockParser::expression() {
  in_.skipBlanks();
  const std::size_t begin = in_.position();
  ExpressionPtr left = term();
  while (left) {
    const std::string_view op = operatorHere({"+", "-", "OR", "XOR"});
    if (op.empty()) break;
    if (!count()) return nullptr;
    ExpressionPtr right = term();
    if (!right) return nullptr;
    left = make(begin, Operation{std::string(op), std::move(left), std::move(right)});
  }
  return left;
}

ExpressionPtr BlockParser::term() {
  in_.skipBlanks();
  const std::size_t begin = in_.position();
  ExpressionPtr left = factor();
  while (left) {
    const std::string_view op = operatorHere({"*", "/", "MOD", "AND"});
    if (op.empty()) break;
    if (!count()) return nullptr;
    ExpressionPtr right = factor();
    if (!right) return nullptr;
    left = make(begin, Operation{std::string(op), std::move(left), std::move(right)});
  }
  return left;
}

ExpressionPtr BlockParser::factor() {
  in_.skipBlanks();
  const char c = in_.peek();
  if (isDigit(c) || c == '.') return number();
  if (c == Reader::kHole) return hole();
  if (c == '#') return variableRef();
  if (c == '[') return bracketed();
  if (isCapital(c)) return function();
  if (c != '-' && c != '+') return unexpected();
  const std::size_t begin = in_.position();
  if (!enter()) return nullptr;
  in_.skip();
  in_.skipBlanks();
  if (in_.peek() == Reader::kHole) warnOfSign(c, begin);
  ExpressionPtr operand = factor();
  leave();
  if (!operand || c == '+') return operand;
  return make(begin, Negated{std::move(operand)});
}

ExpressionPtr BlockParser::number() {
  const std::size_t begin = in_.position();
  bool point = false;
  while (isDigit(in_.peek()) || (in_.peek() == '.' && !point)) {
    point = point || in_.peek() == '.';
    in_.skip();
  }
  const std::string digits(in_.text(begin, in_.position()));
  const SourceRange range = in_.range(begin, in_.position());
  const std::size_t count = digits.size() - (point ? 1 : 0);
  if (count == 0) return syntax(range, "a point without digits is no number");
  if (count > kMostDigits)
    return syntax(range, "`{}` has more than {} digits; a control stops with an alarm", digits, kMostDigits);
  if (in_.peek() == Reader::kHole) {
    diagnostics_.report<diag::DigitsBesideValue>(in_.here(), in_.hole().hole.name, digits);
    return nullptr;
  }
  // parseNumber takes "5." and ".5".
  return make(begin, Number{digits, parseNumber(digits).value_or(0), point});
}

ExpressionPtr BlockParser::hole() {
  const HolePiece& piece = in_.hole();
  const std::size_t begin = in_.position();
  in_.skip();
  const std::size_t digits = in_.position();
  std::size_t end = digits;
  if (in_.peek() == Reader::kHole)
    return syntax(in_.here(), "{} is printed right after {}; the machine reads one number made of both",
                  in_.hole().hole.name, piece.hole.name);
  while (isDigit(in_.peek()) || in_.peek() == '.') {
    in_.skip();
    ++end;
  }
  if (end != digits) {
    diagnostics_.report<diag::DigitsBesideValue>(in_.range(digits, end), piece.hole.name,
                                                 in_.text(digits, end));
    return nullptr;
  }
  return make(begin, piece.hole);
}

ExpressionPtr BlockParser::variableNumber() {
  in_.skipBlanks();
  const char c = in_.peek();
  if (c == '[') return bracketed();
  if (c == Reader::kHole) return hole();
  if (isDigit(c)) return number();
  return syntax(in_.here(), "a `#` takes a number or an expression in brackets after it: `#100`, `#[#1+1]`");
}

ExpressionPtr BlockParser::variableRef() {
  const std::size_t begin = in_.position();
  in_.skip();
  ExpressionPtr number = variableNumber();
  if (!number) return nullptr;
  return make(begin, VariableRef{std::move(number)});
}

ExpressionPtr BlockParser::bracketed() {
  if (!enter()) return nullptr;
  in_.skip();
  ExpressionPtr inner = expression();
  leave();
  if (!inner) return nullptr;
  in_.skipBlanks();
  if (in_.peek() != ']')
    return in_.peek() == Reader::kEnd ? syntax(in_.here(), "a `]` is missing") : unexpected();
  in_.skip();
  return inner;
}

ExpressionPtr BlockParser::function() {
  const std::size_t begin = in_.position();
  const auto name = std::find_if(kFunctions.begin(), kFunctions.end(),
                                 [&](std::string_view one) { return in_.startsWith(one); });
  if (name == kFunctions.end()) return unexpected();
  in_.skip(name->size());
  in_.skipBlanks();
  if (in_.peek() != '[')
    return syntax(in_.here(), "the argument of `{}` is in brackets: `{}[..]`", *name, *name);
  FunctionCall call{std::string(*name), {}};
  if (!enter()) return nullptr;
  do {
    in_.skip(); // [ or ,
    call.arguments.push_back(expression());
    if (!call.arguments.back()) return nullptr;
    in_.skipBlanks();
  } while (in_.peek() == ',');
  leave();
  if (in_.peek() != ']')
    return in_.peek() == Reader::kEnd ? syntax(in_.here(), "a `]` is missing") : unexpected();
  in_.skip();
  in_.skipBlanks();
  // The `/` between the two brackets of ATAN belongs to the function.
  if (*name == "ATAN" && call.arguments.size() == 1 && in_.peek() == '/') {
    const std::size_t slash = in_.position();
    in_.skip();
    in_.skipBlanks();
    if (in_.peek() != '[')
      return syntax(
          in_.range(slash, slash + 1),
          "a division right after `ATAN[..]` belongs to the function; put the function into brackets");
    call.arguments.push_back(bracketed());
    if (!call.arguments.back()) return nullptr;
  }
  const std::size_t wanted = *name == "POW" ? 2 : 1;
  if (call.arguments.size() != wanted && !(*name == "ATAN" && call.arguments.size() == 2))
    return syntax(in_.range(begin, in_.position()), "`{}` takes {} {}", *name, wanted,
                  wanted == 1 ? "argument" : "arguments");
  return make(begin, std::move(call));
}

} // namespace dotek::frontend::nc
