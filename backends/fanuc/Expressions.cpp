// Values in the control's macro language: words, assignments, helper locals for what one line cannot say.
#include "backends/fanuc/MacroNames.h"
#include "backends/fanuc/State.h"
#include "ir/Fold.h"
#include "ir/Rewrite.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends::fanuc {

namespace {

// Digits of a constant in an expression, the zero before the point included (reference 1.1).
constexpr int kConstantDigits = 8;
// A difference that binary arithmetic makes is no lost digit.
constexpr double kSame = 1e-9;

// Name of the function in the control's list.
std::string_view listedAs(ir::UnaryOp op) {
  return op == ir::UnaryOp::ArcTangent ? "ATAN[y]" : functionKey(op);
}

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' '))
    text.remove_prefix(1);
  while (text.ends_with(' '))
    text.remove_suffix(1);
  return text;
}

bool has(const stdlib::Control& control, std::string_view function) {
  return control.functions.contains(std::string(function));
}

// MOD rounds its operands: only whole ones have the same remainder.
bool isWhole(const State& state, const ir::ExpressionPtr& expression) {
  if (const double* value = ir::constantValue(expression)) return *value == std::trunc(*value);
  const auto* use = std::get_if<ir::VariableUse>(&expression->node);
  if (use == nullptr) return false;
  const ir::Kind kind = state.cycle.variable(use->variable).kind;
  return kind == ir::Kind::Count || kind == ir::Kind::WorkOffset || kind == ir::Kind::ToolOffset;
}

// What the control of the program has.
class ControlNotation : public MacroNotation {
public:
  explicit ControlNotation(const State& state) : state_(state) {}
  std::string_view function(ir::UnaryOp op) const override {
    // After an address ROUND rounds to the increment of the word.
    if (op == ir::UnaryOp::Round && state_.inWord) return "";
    return has(state_.control, listedAs(op)) ? functionKey(op) : "";
  }
  Infix infix(ir::BinaryOp op) const override {
    const Infix out = infixOf(op);
    const bool sign = out.text.size() == 1;
    return sign || has(state_.control, trimmed(out.text)) ? out : Infix();
  }

private:
  const State& state_;
};

std::uint32_t depthOf(const State& state) {
  return std::max(1u, state.control.bracketDepth);
}

class Printer : public ExpressionPrinter {
public:
  Printer(State& state, Form form, const ir::Origin& origin)
      : ExpressionPrinter(notation_), state_(state), form_(form), origin_(origin), notation_(state) {}

protected:
  std::string leaf(const ir::ExpressionPtr& expression, std::uint32_t depth) override {
    if (const auto* constant = std::get_if<ir::Constant>(&expression->node))
      return constantText(constant->value, expression->range);
    if (const auto* use = std::get_if<ir::VariableUse>(&expression->node)) return state_.local(use->variable);
    if (const auto* machine = std::get_if<ir::MachineVariable>(&expression->node))
      return subscripted(expression, machine->number, depth);
    if (const auto* result = std::get_if<ir::MeasuredResult>(&expression->node))
      return resultText(state_, result->name, expression->range);
    return "#0";
  }

  std::string aside(const ir::ExpressionPtr& expression) override {
    if (!canWrite(expression)) return "#0";
    const std::uint32_t local = state_.helper();
    if (local == 0) {
      state_.refuse<diag::ExpressionDepth>(rangeOf(expression), state_.control.title);
      return "#0";
    }
    const std::string name = "#" + std::to_string(local);
    ir::Origin origin = origin_;
    origin.reason = "part of an expression";
    const bool before = std::exchange(state_.inWord, false);
    assign(state_, name, expression, origin);
    state_.inWord = before;
    return name;
  }

private:
  SourceRange rangeOf(const ir::ExpressionPtr& expression) const {
    return expression->range.hasPlace() ? expression->range : origin_.range();
  }

  std::string constantText(double value, SourceRange range) {
    if (form_ == Form::Whole && value == std::trunc(value)) return numberText(value);
    const Decimal given = Decimal::of(value);
    const int whole = std::max<int>(1, static_cast<int>(given.integerPart().size()));
    if (whole > kConstantDigits) {
      state_.refuse<diag::NumberTooLarge>(range.hasPlace() ? range : origin_.range(), numberText(value),
                                          kConstantDigits, state_.control.title);
      return "0.";
    }
    const double rounded = given.rounded(kConstantDigits - whole).value();
    if (std::abs(rounded - value) > kSame * std::max(1.0, std::abs(value)))
      state_.diagnostics.report<diag::NumberRounded>(range.hasPlace() ? range : origin_.range(),
                                                     numberText(value), numberText(rounded));
    std::string text = numberText(rounded);
    if (text.find('.') == std::string::npos) text += '.';
    return text;
  }

  std::string subscripted(const ir::ExpressionPtr& whole, const ir::ExpressionPtr& given,
                          std::uint32_t depth) {
    const ir::ExpressionPtr number = tidy(given);
    if (const double* value = ir::constantValue(number)) return "#" + numberText(*value);
    if (depth == 0) return aside(whole);
    Printer inner(state_, Form::Whole, origin_);
    return "#[" + inner.print(number, depth - 1) + "]";
  }

  // Whether the control can compute the topmost operation at all.
  bool canWrite(const ir::ExpressionPtr& expression) {
    if (const auto* unary = std::get_if<ir::Unary>(&expression->node)) {
      const std::string_view name = functionKey(unary->op);
      if (name.empty() || has(state_.control, listedAs(unary->op))) return true;
      state_.refuse<diag::FunctionMissing>(rangeOf(expression), state_.control.title, listedAs(unary->op));
      return false;
    }
    const auto* binary = std::get_if<ir::Binary>(&expression->node);
    if (binary == nullptr || binary->op == ir::BinaryOp::ValueOr) return true;
    const std::string_view name = binary->op == ir::BinaryOp::Direction || binary->op == ir::BinaryOp::Bearing
                                      ? "ATAN[y]/[x]"
                                      : trimmed(infixOf(binary->op).text);
    if (notation_.infix(binary->op).text.empty() && !has(state_.control, name)) {
      state_.refuse<diag::FunctionMissing>(rangeOf(expression), state_.control.title, name);
      return false;
    }
    return true;
  }

  State& state_;
  Form form_;
  const ir::Origin& origin_;
  ControlNotation notation_;
};

bool isVariable(const ir::ExpressionPtr& expression) {
  return std::holds_alternative<ir::VariableUse>(expression->node) ||
         std::holds_alternative<ir::MeasuredResult>(expression->node) ||
         std::holds_alternative<ir::NullValue>(expression->node) ||
         std::holds_alternative<ir::MachineVariable>(expression->node);
}

// "#28"
bool isLocal(std::string_view text) {
  return text.starts_with('#') && text.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

// MOD of what may be no whole number is refused once, wherever it is.
void checkModulo(State& state, const ir::ExpressionPtr& expression, const ir::Origin& origin) {
  if (const auto* unary = std::get_if<ir::Unary>(&expression->node))
    return checkModulo(state, unary->operand, origin);
  const auto* binary = std::get_if<ir::Binary>(&expression->node);
  if (binary == nullptr) return;
  if (binary->op == ir::BinaryOp::Modulo && has(state.control, "MOD") &&
      !(isWhole(state, binary->left) && isWhole(state, binary->right)))
    state.refuse<diag::ModuloOfFractions>(expression->range.hasPlace() ? expression->range : origin.range());
  checkModulo(state, binary->left, origin);
  checkModulo(state, binary->right, origin);
}

void collectTerms(const ir::ExpressionPtr& expression, int sign, double& constant, int& constants,
                  std::vector<std::pair<int, ir::ExpressionPtr>>& terms) {
  if (const double* value = ir::constantValue(expression)) {
    constant += sign * *value;
    ++constants;
    return;
  }
  if (const auto* unary = std::get_if<ir::Unary>(&expression->node);
      unary != nullptr && unary->op == ir::UnaryOp::Negate)
    return collectTerms(unary->operand, -sign, constant, constants, terms);
  const auto* binary = std::get_if<ir::Binary>(&expression->node);
  if (binary == nullptr || (binary->op != ir::BinaryOp::Add && binary->op != ir::BinaryOp::Subtract)) {
    terms.emplace_back(sign, expression);
    return;
  }
  collectTerms(binary->left, sign, constant, constants, terms);
  collectTerms(binary->right, binary->op == ir::BinaryOp::Add ? sign : -sign, constant, constants, terms);
}

// A variable of the machine that is empty counts as 0 in arithmetic by itself.
ir::ExpressionPtr withoutZeroes(const ir::ExpressionPtr& expression) {
  const auto operand = [](const ir::ExpressionPtr& given) {
    const ir::ExpressionPtr value = withoutZeroes(given);
    const auto* unary = std::get_if<ir::Unary>(&value->node);
    const bool machine = unary != nullptr && unary->op == ir::UnaryOp::NullAsZero &&
                         std::holds_alternative<ir::MachineVariable>(unary->operand->node);
    return machine ? unary->operand : value;
  };
  if (const auto* machine = std::get_if<ir::MachineVariable>(&expression->node)) {
    const ir::ExpressionPtr number = withoutZeroes(machine->number);
    return number == machine->number ? expression : ir::machineVariable(number, expression->range);
  }
  if (const auto* unary = std::get_if<ir::Unary>(&expression->node)) {
    const bool zero = unary->op == ir::UnaryOp::NullAsZero;
    const ir::ExpressionPtr inner = zero ? withoutZeroes(unary->operand) : operand(unary->operand);
    return inner == unary->operand ? expression : ir::unary(unary->op, inner, expression->range);
  }
  const auto* binary = std::get_if<ir::Binary>(&expression->node);
  if (binary == nullptr || binary->op == ir::BinaryOp::ValueOr) return expression;
  const ir::ExpressionPtr left = operand(binary->left), right = operand(binary->right);
  if (left == binary->left && right == binary->right) return expression;
  return ir::binary(binary->op, left, right, expression->range);
}

// Of a control that has only ATAN[y]/[x]: the angle of a ratio is that of the ratio over 1.
ir::ExpressionPtr withArcTangents(const State& state, const ir::ExpressionPtr& expression) {
  if (has(state.control, "ATAN[y]") || !has(state.control, "ATAN[y]/[x]")) return expression;
  return ir::rewrite(expression, [](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
    const auto* unary = std::get_if<ir::Unary>(&node->node);
    if (unary == nullptr || unary->op != ir::UnaryOp::ArcTangent) return node;
    return ir::binary(ir::BinaryOp::Direction, ir::constant(1), unary->operand, node->range);
  });
}

std::string textOf(State& state, const ir::ExpressionPtr& given, Form form, const ir::Origin& origin,
                   std::uint32_t depth) {
  const ir::ExpressionPtr value = withArcTangents(state, withoutZeroes(given));
  checkModulo(state, value, origin);
  Printer printer(state, form, origin);
  return printer.print(value, depth);
}

// Angle above -180 up to 180, whichever way the control's parameter has ATAN count.
void assignDirection(State& state, const std::string& left, const ir::Binary& binary,
                     const ir::Origin& origin) {
  const std::string y = textOf(state, binary.right, Form::Length, origin, depthOf(state) - 1);
  const std::string x = textOf(state, binary.left, Form::Length, origin, depthOf(state) - 1);
  state.sheet.add(left + "=ATAN[" + y + "]/[" + x + "]", origin);
  const Mark done = state.mark();
  state.sheet.jump("IF[" + left + " LE 180.]GOTO ", done, origin);
  state.sheet.add(left + "=" + left + "-360.", origin);
  state.sheet.place(done);
}

void assignValueOr(State& state, const std::string& left, const ir::Binary& binary,
                   const ir::Origin& origin) {
  // `left` may be read by the second value: a helper takes the result first.
  const std::uint32_t local = state.helper();
  if (local == 0) {
    state.refuse<diag::ExpressionDepth>(origin.range(), state.control.title);
    return;
  }
  const std::string name = "#" + std::to_string(local);
  assign(state, name, binary.left, origin);
  const Mark done = state.mark();
  state.sheet.jump("IF[" + name + " NE #0]GOTO ", done, origin);
  assign(state, name, binary.right, origin);
  state.sheet.place(done);
  state.sheet.add(left + "=" + name, origin);
}

} // namespace

ir::ExpressionPtr systemVariable(int number) {
  return ir::machineVariable(ir::constant(number));
}

ir::ExpressionPtr tidy(const ir::ExpressionPtr& expression) {
  const ir::ExpressionPtr simple = ir::simplify(expression);
  double constant = 0;
  int constants = 0;
  std::vector<std::pair<int, ir::ExpressionPtr>> terms;
  collectTerms(simple, 1, constant, constants, terms);
  const std::size_t before = terms.size();
  for (std::size_t i = 0; i < terms.size(); ++i)
    for (std::size_t j = i + 1; j < terms.size(); ++j)
      if (terms[i].first == -terms[j].first && ir::equal(terms[i].second, terms[j].second)) {
        terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(j));
        terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(i));
        --i;
        break;
      }
  if (terms.size() == before && constants < 2) return simple;
  // What a sum of decimal numbers means, without the dust of binary arithmetic.
  constant = Decimal::of(constant).rounded(9).value();
  ir::ExpressionPtr out;
  std::stable_partition(terms.begin(), terms.end(), [](const auto& term) { return term.first > 0; });
  for (const auto& [sign, term] : terms) {
    if (out == nullptr)
      out = sign > 0 ? term : ir::unary(ir::UnaryOp::Negate, term, term->range);
    else
      out = ir::binary(sign > 0 ? ir::BinaryOp::Add : ir::BinaryOp::Subtract, out, term, expression->range);
  }
  if (out == nullptr) return ir::constant(constant, expression->range);
  if (constant == 0) return out;
  return ir::binary(constant > 0 ? ir::BinaryOp::Add : ir::BinaryOp::Subtract, out,
                    ir::constant(std::abs(constant)), expression->range);
}

std::string numberWord(State& state, double value, Form form, SourceRange range) {
  const bool whole = value == std::trunc(value);
  if (form != Form::Length && !whole) {
    state.refuse<diag::SelectorFraction>(range, numberText(value));
    return "0";
  }
  const Decimal rounded = Decimal::of(value).rounded(state.control.decimals);
  if (static_cast<int>(rounded.integerPart().size()) > state.control.integerDigits) {
    state.refuse<diag::NumberTooLarge>(range, numberText(value), state.control.integerDigits,
                                       state.control.title);
    return "0.";
  }
  if (std::abs(rounded.value() - value) > kSame)
    state.diagnostics.report<diag::NumberRounded>(range, numberText(value), numberText(rounded.value()));
  std::string text = numberText(rounded.value());
  if (form != Form::Whole && text.find('.') == std::string::npos) text += '.';
  return text;
}

std::string word(State& state, char address, const ir::ExpressionPtr& given, Form form,
                 const ir::Origin& origin) {
  const ir::ExpressionPtr value = tidy(given);
  const SourceRange range = value->range.hasPlace() ? value->range : origin.range();
  std::string text(1, address);
  if (const auto* constant = std::get_if<ir::Constant>(&value->node)) {
    if (form == Form::Source && !constant->digits.empty()) return text + constant->digits;
    return text + numberWord(state, constant->value, form == Form::Source ? Form::Length : form, range);
  }
  const bool before = std::exchange(state.inWord, true);
  const Form inner = form == Form::Whole ? Form::Whole : Form::Length;
  const auto* unary = std::get_if<ir::Unary>(&value->node);
  const bool isSigned = unary != nullptr && unary->op == ir::UnaryOp::Negate && isVariable(unary->operand);
  if (isVariable(value) || isSigned) {
    if (isSigned) text += '-';
    text += textOf(state, isSigned ? unary->operand : value, inner, origin, depthOf(state));
  } else {
    const std::string inside = textOf(state, value, inner, origin, depthOf(state) - 1);
    // A helper holds it all: bare, so that a null still leaves the word out.
    text += isLocal(inside) ? inside : "[" + inside + "]";
  }
  state.inWord = before;
  return text;
}

std::string valueText(State& state, const ir::ExpressionPtr& value, const ir::Origin& origin) {
  return textOf(state, tidy(value), Form::Length, origin, depthOf(state));
}

std::string operandText(State& state, const ir::ExpressionPtr& value, const ir::Origin& origin,
                        std::uint32_t depth) {
  return textOf(state, tidy(value), Form::Length, origin, depth);
}

std::string machineText(State& state, const ir::ExpressionPtr& number, const ir::Origin& origin) {
  return textOf(state, ir::machineVariable(number), Form::Whole, origin, depthOf(state));
}

void assign(State& state, const std::string& left, const ir::ExpressionPtr& given, const ir::Origin& origin) {
  const ir::ExpressionPtr value = withArcTangents(state, tidy(given));
  if (const auto* binary = std::get_if<ir::Binary>(&value->node)) {
    if (binary->op == ir::BinaryOp::ValueOr) return assignValueOr(state, left, *binary, origin);
    if (binary->op == ir::BinaryOp::Direction && has(state.control, "ATAN[y]/[x]"))
      return assignDirection(state, left, *binary, origin);
    if (binary->op == ir::BinaryOp::Bearing && has(state.control, "ATAN[y]/[x]")) {
      // As the source has it: its range is a parameter of the control.
      const std::string y = textOf(state, binary->right, Form::Length, origin, depthOf(state) - 1);
      const std::string x = textOf(state, binary->left, Form::Length, origin, depthOf(state) - 1);
      state.sheet.add(left + "=ATAN[" + y + "]/[" + x + "]", origin);
      return;
    }
  }
  const std::string text = valueText(state, value, origin);
  state.sheet.add(left + "=" + text, origin);
}

} // namespace dotek::backends::fanuc
