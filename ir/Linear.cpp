#include "ir/Linear.h"

#include "ir/Evaluate.h"
#include "ir/Fold.h"
#include "ir/Names.h"
#include "support/Decimal.h"

#include <limits>
#include <utility>

namespace dotek::ir {
namespace {

// A decimal number: mantissa * 10^exponent.
struct Scaled {
  std::int64_t mantissa = 0;
  int exponent = 0;
};

constexpr int kMostDigits = 18; // any number of so many digits is an int64

Scaled scaled(double value) {
  const Decimal decimal = Decimal::of(value);
  Scaled out;
  for (const char c : decimal.digits) // 17 at most
    out.mantissa = out.mantissa * 10 + (c - '0');
  if (decimal.negative) out.mantissa = -out.mantissa;
  out.exponent = decimal.point - static_cast<int>(decimal.digits.size());
  return out;
}

// The double whose shortest text is exactly this number; nullopt: there is none.
std::optional<double> exact(const Scaled& number) {
  Decimal decimal;
  decimal.negative = number.mantissa < 0;
  decimal.digits = std::to_string(number.mantissa).substr(decimal.negative ? 1 : 0);
  decimal.point = number.exponent + static_cast<int>(decimal.digits.size());
  while (decimal.digits.ends_with('0'))
    decimal.digits.pop_back();
  if (decimal.isZero()) return 0.0;
  const double value = decimal.value();
  return Decimal::of(value) == decimal ? std::optional(value) : std::nullopt;
}

bool fits(std::int64_t a, std::int64_t factor) {
  const std::int64_t most = std::numeric_limits<std::int64_t>::max() / factor;
  return a <= most && a >= -most;
}

// With `exponent`, which is not above its own.
std::optional<std::int64_t> mantissaAt(const Scaled& number, int exponent) {
  if (number.mantissa == 0) return 0;
  if (number.exponent - exponent > kMostDigits) return std::nullopt;
  std::int64_t out = number.mantissa;
  for (int i = number.exponent; i > exponent; --i) {
    if (!fits(out, 10)) return std::nullopt;
    out *= 10;
  }
  return out;
}

} // namespace

std::optional<double> exactSum(double a, double b) {
  if (a == 0) return b;
  if (b == 0) return a;
  const Scaled x = scaled(a);
  const Scaled y = scaled(b);
  const int exponent = x.exponent < y.exponent ? x.exponent : y.exponent;
  const auto left = mantissaAt(x, exponent);
  const auto right = mantissaAt(y, exponent);
  if (!left || !right || !fits(*left, 2) || !fits(*right, 2)) return std::nullopt;
  return exact({*left + *right, exponent});
}

std::optional<double> exactProduct(double a, double b) {
  const Scaled x = scaled(a);
  const Scaled y = scaled(b);
  if (x.mantissa == 0 || y.mantissa == 0) return 0.0;
  if (!fits(x.mantissa, y.mantissa < 0 ? -y.mantissa : y.mantissa)) return std::nullopt;
  return exact({x.mantissa * y.mantissa, x.exponent + y.exponent});
}

std::optional<LinearForm> add(const LinearForm& a, const LinearForm& b, double factorOfB) {
  LinearForm out = a;
  const auto scaledSum = [&](double mine, double other) -> std::optional<double> {
    const auto product = exactProduct(other, factorOfB);
    return product ? exactSum(mine, *product) : std::nullopt;
  };
  const auto constant = scaledSum(a.constant, b.constant);
  if (!constant) return std::nullopt;
  out.constant = *constant;
  for (const auto& [symbol, coefficient] : b.terms) {
    const auto sum = scaledSum(out.terms[symbol], coefficient);
    if (!sum) return std::nullopt;
    if (*sum == 0)
      out.terms.erase(symbol);
    else
      out.terms[symbol] = *sum;
  }
  return out;
}

namespace {

class Builder {
public:
  explicit Builder(const Cycle& cycle) : names_(cycle, Names::Numbers::Plain) {}

  std::optional<LinearForm> form(const ExpressionPtr& expression) const {
    if (const double* value = constantValue(expression)) return LinearForm{*value, {}};
    if (const auto* use = std::get_if<VariableUse>(&expression->node))
      return LinearForm{0, {{names_.variable(use->variable), 1}}};
    if (const auto* node = std::get_if<Unary>(&expression->node)) {
      if (node->op == UnaryOp::Negate) return sum(LinearForm{}, form(node->operand), -1);
    } else if (const auto* pair = std::get_if<Binary>(&expression->node)) {
      if (pair->op == BinaryOp::Add) return sum(form(pair->left), form(pair->right), 1);
      if (pair->op == BinaryOp::Subtract) return sum(form(pair->left), form(pair->right), -1);
      if (pair->op == BinaryOp::Multiply) return product(expression, *pair);
      if (pair->op == BinaryOp::Divide) return quotient(expression, *pair);
    }
    return symbol(expression);
  }

private:
  static std::optional<LinearForm> sum(const std::optional<LinearForm>& a, const std::optional<LinearForm>& b,
                                       double factor) {
    if (!b) return std::nullopt;
    return a ? add(*a, *b, factor) : std::nullopt;
  }

  std::optional<LinearForm> product(const ExpressionPtr& whole, const Binary& node) const {
    const auto left = form(node.left);
    const auto right = form(node.right);
    if (!left || !right) return std::nullopt;
    if (left->terms.empty()) return add({}, *right, left->constant);
    if (right->terms.empty()) return add({}, *left, right->constant);
    return symbol(whole);
  }

  // By a number whose inverse is a decimal: 2, 5, 0.25. A third stays one.
  std::optional<LinearForm> quotient(const ExpressionPtr& whole, const Binary& node) const {
    const auto left = form(node.left);
    const auto right = form(node.right);
    if (!left || !right) return std::nullopt;
    if (!right->terms.empty()) return symbol(whole);
    if (right->constant == 0) return std::nullopt;
    const double inverse = 1 / right->constant;
    if (exactProduct(inverse, right->constant) != 1.0) return symbol(whole);
    return add({}, *left, inverse);
  }

  std::optional<LinearForm> symbol(const ExpressionPtr& expression) const {
    const ExpressionPtr simple = simplify(expression);
    if (evaluate(*simple, {}).state == Scalar::State::Failed) return std::nullopt;
    if (std::holds_alternative<NullValue>(simple->node)) return std::nullopt;
    if (!equal(simple, expression)) return form(simple);
    std::string text;
    write(*simple, names_, text);
    return LinearForm{0, {{std::move(text), 1}}};
  }

  Names names_;
};

} // namespace

std::optional<LinearForm> linear(const ExpressionPtr& expression, const Cycle& cycle) {
  return Builder(cycle).form(expression);
}

bool provenEqual(const ExpressionPtr& a, const ExpressionPtr& b, const Cycle& cycle) {
  const Builder builder(cycle);
  const auto left = builder.form(a);
  const auto right = builder.form(b);
  return left && right && *left == *right;
}

} // namespace dotek::ir
