// Numbers of words: decimal points, pictures, formulas.
#include "frontend/nc/Lifter.h"
#include "ir/Walk.h"
#include "stdlib/VariableNumbers.h"
#include "support/Decimal.h"
#include "support/messages/ComPost.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dotek::frontend::nc {
namespace {

// These messages put the name between backticks themselves.
std::string bareName(const Hole& hole) {
  std::string out = hole.name;
  std::erase(out, '`');
  return out;
}

struct UnaryName {
  std::string_view name;
  ir::UnaryOp op;
};
constexpr std::array<UnaryName, 13> kUnary = {{{"SIN", ir::UnaryOp::Sine},
                                               {"COS", ir::UnaryOp::Cosine},
                                               {"TAN", ir::UnaryOp::Tangent},
                                               {"ACOS", ir::UnaryOp::ArcCosine},
                                               {"ATAN", ir::UnaryOp::ArcTangent},
                                               {"SQRT", ir::UnaryOp::SquareRoot},
                                               {"ABS", ir::UnaryOp::Absolute},
                                               {"FIX", ir::UnaryOp::Truncate},
                                               {"FUP", ir::UnaryOp::RoundUp},
                                               {"ROUND", ir::UnaryOp::Round},
                                               {"LN", ir::UnaryOp::Logarithm},
                                               {"EXP", ir::UnaryOp::Exponential},
                                               {"ASIN", ir::UnaryOp::ArcSine}}};

struct BinaryName {
  std::string_view name;
  ir::BinaryOp op;
};
constexpr std::array<BinaryName, 8> kBinary = {{{"+", ir::BinaryOp::Add},
                                                {"-", ir::BinaryOp::Subtract},
                                                {"*", ir::BinaryOp::Multiply},
                                                {"/", ir::BinaryOp::Divide},
                                                {"MOD", ir::BinaryOp::Modulo},
                                                {"AND", ir::BinaryOp::BitAnd},
                                                {"OR", ir::BinaryOp::BitOr},
                                                {"XOR", ir::BinaryOp::BitXor}}};

const char* otherMode(stdlib::DecimalMode mode) {
  return mode == stdlib::DecimalMode::Increment ? "calculator" : "increment";
}

void notePicture(PictureUses& uses, SourceRange where, const Hole& hole) {
  PictureUse& use = uses[hole.picture->text()];
  if (use.names.empty()) use.first = where;
  use.decimals = hole.picture->decimals();
  if (std::find(use.names.begin(), use.names.end(), hole.name) == use.names.end())
    use.names.push_back(hole.name);
}

// "the fields `X` and `Z` and the host input `clearance`": names of one kind are together.
std::string listed(const std::vector<std::string>& names) {
  std::vector<std::pair<std::string, std::vector<std::string>>> kinds;
  for (const std::string& name : names) {
    const std::size_t tick = std::min(name.find('`'), name.size());
    const std::string kind = name.substr(0, tick);
    auto at = std::find_if(kinds.begin(), kinds.end(), [&](const auto& one) { return one.first == kind; });
    if (at == kinds.end()) at = kinds.insert(at, {kind, {}});
    at->second.push_back(name.substr(tick));
  }
  const auto joined = [](const std::vector<std::string>& parts) {
    std::string out;
    for (std::size_t i = 0; i < parts.size(); ++i)
      out += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
    return out;
  };
  std::vector<std::string> groups;
  for (auto& [kind, members] : kinds) {
    if (members.size() > 1 && kind.ends_with(' ')) kind.insert(kind.size() - 1, "s");
    groups.push_back(kind + joined(members));
  }
  return joined(groups);
}

double power10(int exponent) {
  double out = 1;
  for (int i = 0; i < exponent; ++i)
    out *= 10;
  return out;
}

} // namespace

void reportPictures(LiftContext& context) {
  const auto verb = [](const PictureUse& use) { return use.names.size() > 1 ? "are" : "is"; };
  for (const auto& [picture, use] : context.blankZero)
    context.diagnostics.report<diag::PictureZero>(use.first, listed(use.names), verb(use), picture);
  for (const auto& [picture, use] : context.coarse)
    context.diagnostics.report<diag::PictureDecimals>(use.first, listed(use.names), verb(use), picture,
                                                      use.decimals, context.control.decimals);
}

std::optional<double> literalOf(const Expression& value) {
  if (const auto* number = std::get_if<Number>(&value.node)) return number->value;
  const auto* negated = std::get_if<Negated>(&value.node);
  const auto* number = negated == nullptr ? nullptr : std::get_if<Number>(&negated->operand->node);
  if (number == nullptr) return std::nullopt;
  return number->value == 0 ? 0 : -number->value;
}

std::string wordText(const Word& word) {
  std::string text(1, word.address);
  if (!word.value) return text;
  const auto* negated = std::get_if<Negated>(&word.value->node);
  const Expression& inner = negated == nullptr ? *word.value : *negated->operand;
  const auto* number = std::get_if<Number>(&inner.node);
  return number == nullptr ? text : text + (negated == nullptr ? "" : "-") + number->digits;
}

double Lifter::increments(double count) const {
  // Division by 1000 rounds once; 0.001 is no double.
  const double perUnit = std::round(1 / context_.control.increment);
  return perUnit * context_.control.increment == 1.0 ? count / perUnit : count * context_.control.increment;
}

std::optional<double> Lifter::fixedValue(const Hole& hole) const {
  if (const double* constant = ir::constantValue(hole.value)) return *constant;
  const auto* use = std::get_if<ir::VariableUse>(&hole.value->node);
  if (use == nullptr || !context_.fixed) return std::nullopt;
  return context_.fixed(use->variable);
}

std::optional<double> Lifter::knownNumber(const Expression& value) const {
  if (const auto literal = literalOf(value)) return literal;
  const auto* hole = std::get_if<Hole>(&value.node);
  return hole == nullptr ? std::nullopt : fixedValue(*hole);
}

ir::ExpressionPtr Lifter::value(const Word& word, Reading reading) {
  const Expression& value = *word.value;
  const auto* negated = std::get_if<Negated>(&value.node);
  const Expression& inner = negated == nullptr ? value : *negated->operand;
  if (const auto* number = std::get_if<Number>(&inner.node)) {
    const bool minus = negated != nullptr && number->value != 0;
    return literal(word, minus ? -number->value : number->value, (minus ? "-" : "") + number->digits,
                   number->point, reading);
  }
  if (const auto* hole = std::get_if<Hole>(&inner.node)) {
    ir::ExpressionPtr out = holeValue(inner, *hole, reading);
    return out && negated != nullptr ? ir::unary(ir::UnaryOp::Negate, out, value.range) : out;
  }
  return formula(value, true); // no decimal mode inside a formula
}

ir::ExpressionPtr Lifter::rawValue(const Word& word) {
  // The control reads a literal as it is; the target writes a value with a point.
  const bool counts = !literalOf(*word.value) && context_.control.isLength(word.address);
  return value(word, {ir::Kind::Number, counts});
}

ir::ExpressionPtr Lifter::literal(const Word& word, double value, const std::string& digits, bool point,
                                  Reading reading) {
  if (point || !reading.increments) return ir::constant(value, word.value->range, digits);
  const stdlib::Control& control = context_.control;
  const bool counts = control.decimal == stdlib::DecimalMode::Increment;
  const double small = increments(value);
  const double read = counts ? small : value;
  if (read != (counts ? value : small)) {
    context_.diagnostics.report<diag::DecimalPoint>(word.range, "`" + wordText(word) + "`", control.name,
                                                    numberText(read), otherMode(control.decimal),
                                                    numberText(counts ? value : small));
  }
  return ir::constant(read, word.value->range, counts ? "" : digits);
}

ir::ExpressionPtr Lifter::holeValue(const Expression& at, const Hole& hole, Reading reading) {
  if (!checkPicture(at.range, hole, reading)) return nullptr;
  ir::ExpressionPtr out = hole.value;
  if (hole.picture == nullptr || hole.picture->printsPoint()) return out;
  // Without a point the machine reads the digits: the value, or with an implied point a multiple of it.
  const double digits = hole.picture->impliedPoint() ? power10(hole.picture->decimals()) : 1;
  if (digits != 1) out = ir::binary(ir::BinaryOp::Multiply, out, ir::constant(digits, at.range), at.range);
  if (!reading.increments) return out;
  const bool counts = context_.control.decimal == stdlib::DecimalMode::Increment;
  if (fixedValue(hole) != 0.0) {
    const auto timesValue = [](double factor) {
      return factor == 1 ? std::string("its value") : numberText(factor) + " times its value";
    };
    const std::string times = timesValue(digits);
    const std::string small = timesValue(increments(digits));
    context_.diagnostics.report<diag::DecimalPoint>(
        at.range, "what is printed for " + hole.name, context_.control.name, counts ? small : times,
        otherMode(context_.control.decimal), counts ? times : small);
  }
  if (!counts) return out;
  const double perUnit = std::round(1 / context_.control.increment);
  if (perUnit == digits) return hole.value; // an implied point of the control's own increment
  return ir::binary(ir::BinaryOp::Divide, out, ir::constant(perUnit, at.range), at.range);
}

bool Lifter::checkPicture(SourceRange where, const Hole& hole, Reading reading) {
  if (hole.picture == nullptr) return true;
  if (const std::optional<double> fixed = fixedValue(hole)) {
    const Picture::Printed printed = hole.picture->print(*fixed);
    if (printed.fit == Picture::Fit::DoesNotFit)
      return refuse<diag::ValueDoesNotFit>(where, bareName(hole), numberText(*fixed), hole.picture->text(),
                                           *fixed == std::trunc(*fixed) ? "" : " once it is rounded");
    if (printed.text.empty())
      context_.diagnostics.report<diag::BareAddress>(where, bareName(hole), hole.picture->text());
  } else if (reading.kind == ir::Kind::Length && hole.picture->zeroPrintsNothing()) {
    notePicture(context_.blankZero, where, hole);
  }
  if (reading.kind == ir::Kind::Length && hole.picture->decimals() < context_.control.decimals)
    notePicture(context_.coarse, where, hole);
  return true;
}

// A variable that is not set counts as 0 in a formula.
ir::ExpressionPtr Lifter::operand(const Expression& expression, bool inWord) {
  ir::ExpressionPtr out = formula(expression, inWord);
  if (out && std::holds_alternative<ir::MachineVariable>(out->node))
    return ir::unary(ir::UnaryOp::NullAsZero, out, expression.range);
  return out;
}

ir::ExpressionPtr Lifter::formula(const Expression& expression, bool inWord) {
  const SourceRange range = expression.range;
  if (const auto* number = std::get_if<Number>(&expression.node))
    return ir::constant(number->value, range, number->digits);
  if (const auto* hole = std::get_if<Hole>(&expression.node)) return holeValue(expression, *hole, {});
  if (const auto* variable = std::get_if<VariableRef>(&expression.node))
    return variableValue(expression, *variable);
  if (const auto* negated = std::get_if<Negated>(&expression.node)) {
    if (const auto literal = literalOf(expression)) {
      const auto& digits = std::get<Number>(negated->operand->node).digits;
      return ir::constant(*literal, range, (*literal < 0 ? "-" : "") + digits);
    }
    const ir::ExpressionPtr inner = operand(*negated->operand, inWord);
    return inner ? ir::unary(ir::UnaryOp::Negate, inner, range) : nullptr;
  }
  if (const auto* op = std::get_if<Operation>(&expression.node)) return operation(expression, *op, inWord);
  return functionCall(expression, std::get<FunctionCall>(expression.node), inWord);
}

ir::ExpressionPtr Lifter::operation(const Expression& expression, const Operation& operation, bool inWord) {
  const bool word = operation.op.size() > 1; // MOD, AND, OR, XOR
  if (word && !context_.control.functions.contains(operation.op)) {
    refuse<diag::FunctionNotRead>(expression.range, operation.op,
                                  "the control `" + context_.control.name + "` does not have it");
    return nullptr;
  }
  const ir::ExpressionPtr left = operand(*operation.left, inWord);
  const ir::ExpressionPtr right = left ? operand(*operation.right, inWord) : nullptr;
  if (!right) return nullptr;
  for (const BinaryName& one : kBinary) {
    if (one.name == operation.op) return ir::binary(one.op, left, right, expression.range);
  }
  return nullptr;
}

ir::ExpressionPtr Lifter::functionCall(const Expression& expression, const FunctionCall& call, bool inWord) {
  const auto notRead = [&](std::string_view why) -> ir::ExpressionPtr {
    refuse<diag::FunctionNotRead>(expression.range, call.name, why);
    return nullptr;
  };
  const bool one = call.name == "ATAN" && call.arguments.size() == 1;
  if (!context_.control.functions.contains(one ? "ATAN[y]" : call.name))
    return notRead("the control `" + context_.control.name + "` does not have it");
  if (call.name == "ASIN" || (call.name == "ATAN" && call.arguments.size() == 2))
    context_.diagnostics.report<diag::AngleRange>(expression.range,
                                                  call.name == "ASIN" ? "ASIN[..]" : "ATAN[..]/[..]");
  if (call.name == "ATAN" && call.arguments.size() == 2) {
    const ir::ExpressionPtr y = operand(*call.arguments[0], inWord);
    const ir::ExpressionPtr x = y ? operand(*call.arguments[1], inWord) : nullptr;
    return x ? ir::binary(ir::BinaryOp::Bearing, x, y, expression.range) : nullptr;
  }
  if (call.name == "ROUND" && inWord)
    return notRead("in a word of NC it rounds to the least increment of the word on some controls");
  for (const UnaryName& known : kUnary) {
    if (known.name != call.name) continue;
    const ir::ExpressionPtr inner = operand(*call.arguments.front(), inWord);
    return inner ? ir::unary(known.op, inner, expression.range) : nullptr;
  }
  return notRead("Dotek has no translation of it");
}

bool Lifter::isComputed(const Expression& number) {
  return std::holds_alternative<Operation>(number.node) || std::holds_alternative<VariableRef>(number.node) ||
         std::holds_alternative<FunctionCall>(number.node);
}

ir::ExpressionPtr Lifter::computedNumber(const Expression& number) {
  const ir::ExpressionPtr out = formula(number, false);
  if (!out) return nullptr;
  // From a common variable on, over the offsets of work systems (`#[5201+20*#1]`, `#[5200+20*#1+#2]` with the
  // axis as a number) or of tools: it reaches no local, which would be another program's.
  const auto first = ir::firstNumber(out);
  const stdlib::Control& control = context_.control;
  if (first && (control.isCommon(*first) || stdlib::isOfOffsets(control, *first) ||
                stdlib::isOfTools(control, *first)))
    return out;
  refuse<diag::ComputedVariable>(number.range);
  return nullptr;
}

// nullopt: reported.
std::optional<std::uint32_t> Lifter::variableNumber(const Expression& number) {
  const std::optional<double> known = knownNumber(number);
  const bool whole = known && *known >= 0 && *known <= 99999999 && *known == std::trunc(*known);
  if (!whole) {
    refuse<diag::ComputedVariable>(number.range);
    return std::nullopt;
  }
  const auto n = static_cast<std::uint32_t>(*known);
  if (n <= context_.control.locals) {
    refuse<diag::LocalOfCaller>(number.range, n,
                                n == 0 ? "is always empty" : "belongs to the program that calls");
    return std::nullopt;
  }
  return n;
}

ir::ExpressionPtr Lifter::variableValue(const Expression& expression, const VariableRef& variable) {
  if (isComputed(*variable.number)) {
    const ir::ExpressionPtr computed = computedNumber(*variable.number);
    return computed ? ir::machineVariable(computed, expression.range) : nullptr;
  }
  const std::optional<std::uint32_t> number = variableNumber(*variable.number);
  if (!number) return nullptr;
  if (context_.measured != nullptr) {
    for (const stdlib::MacroResult& result : context_.measured->results) {
      if (result.variable == *number && result.name) return ir::result(*result.name, expression.range);
    }
  }
  if (context_.macros != nullptr) {
    for (const auto& [first, last] : context_.macros->scratch) {
      if (*number < first || *number > last || context_.stored.contains(*number)) continue;
      if (context_.diagnostics.hasErrors()) break; // the measurement before may be what was refused
      context_.diagnostics.report<diag::ScratchRead>(
          expression.range, *number, context_.macros->name,
          context_.measured == nullptr ? "nothing was measured before" : "what it holds then is not known");
      break;
    }
  }
  return ir::machineVariable(ir::constant(*number, variable.number->range), expression.range);
}

} // namespace dotek::frontend::nc
