// Values and conditions: constants get the unit of their place.
#include "backends/cycle/State.h"
#include "ir/Evaluate.h"
#include "ir/Kinds.h"
#include "support/Decimal.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::backends::cycle {

namespace {

constexpr int kSum = 1, kProduct = 2, kFactor = 3; // how tightly what is printed binds

struct Printed {
  std::string text; // "": refused
  int binds = kFactor;
};

std::string bracketed(const Printed& one, int least) {
  return one.text.empty() || one.binds >= least ? one.text : "(" + one.text + ")";
}

// `cos(30 deg)` of what was computed from COS[30.]. "": another number.
std::string functionOfAngle(const ir::Constant& constant, ir::Kind want) {
  constexpr int kQuarter = 90;
  if (!constant.digits.empty() || (want != ir::Kind::Number && want != ir::Kind::Ratio)) return "";
  constexpr std::size_t kShort = 6; // characters that a person writes
  if (numberText(constant.value).size() <= kShort) return "";
  const double value = std::abs(constant.value);
  for (int degrees = 1; degrees < kQuarter; ++degrees)
    for (const auto& [name, op] : {std::pair("cos", ir::UnaryOp::Cosine), std::pair("sin", ir::UnaryOp::Sine),
                                   std::pair("tan", ir::UnaryOp::Tangent)}) {
      const ir::Scalar made = ir::evaluate(*ir::unary(op, ir::constant(degrees)), {});
      if (made.known() && made.value == value)
        return fmt::format("{}{}({} deg)", constant.value < 0 ? "-" : "", name, degrees);
    }
  return "";
}

bool isDimension(ir::Kind kind) {
  return kind == ir::Kind::Length || kind == ir::Kind::Angle || kind == ir::Kind::Feed;
}

class Printer {
public:
  Printer(State& state, SourceRange range) : state_(state), range_(range) {}

  Printed value(const ir::ExpressionPtr& expression, ir::Kind want) {
    if (const auto* constant = std::get_if<ir::Constant>(&expression->node)) {
      if (std::string angle = functionOfAngle(*constant, want); !angle.empty())
        return {std::move(angle), constant->value < 0 ? kProduct : kFactor};
      Printed out{literal(constant->value, want, constant->digits), kFactor};
      if (constant->value < 0) out.binds = kProduct;
      return out;
    }
    if (const auto* use = std::get_if<ir::VariableUse>(&expression->node)) {
      const auto name = state_.names.find(use->variable);
      return {name == state_.names.end() ? "" : name->second, kFactor};
    }
    if (const auto* result = std::get_if<ir::MeasuredResult>(&expression->node)) {
      const auto found = state_.measured.find(result->name);
      if (found != state_.measured.end())
        return {found->second, found->second.find(' ') == std::string::npos ? kFactor : kSum};
      return refuse(fmt::format("{} of this measurement", ir::resultTitle(result->name)),
                    state_.measured.empty() && state_.joined
                        ? "what was measured last depends on the way here; copy it after each of the calls"
                        : "take what the touch or the called cycle gives instead");
    }
    if (const auto* number = std::get_if<ir::MachineVariable>(&expression->node)) {
      const double* value = ir::constantValue(number->number);
      return refuse(fmt::format("the variable #{} of the machine", value ? numberText(*value) : "[..]"),
                    "a cycle reads its parameters and what it measures; make a parameter of it");
    }
    if (const auto* unary = std::get_if<ir::Unary>(&expression->node)) return unaryText(*unary, want);
    if (const auto* binary = std::get_if<ir::Binary>(&expression->node)) return binaryText(*binary, want);
    return refuse("a value that is not given", "a cycle asks `given NAME` for an optional parameter");
  }

  std::string condition(const ir::ConditionPtr& condition, int least = 0) {
    constexpr int kOr = 1, kAnd = 2, kNot = 3;
    if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node)) return compared(*comparison);
    if (const auto* junction = std::get_if<ir::Junction>(&condition->node)) {
      const bool all = junction->op == ir::Connective::And;
      const int own = all ? kAnd : kOr;
      const std::string left = this->condition(junction->left, own);
      const std::string right = this->condition(junction->right, own);
      if (left.empty() || right.empty()) return "";
      std::string text = left + (all ? " and " : " or ") + right;
      return own < least ? "(" + text + ")" : text;
    }
    const auto* inner = std::get_if<ir::Not>(&condition->node);
    const ir::ConditionPtr& bare = inner == nullptr ? condition : inner->inner;
    if (const auto* null = std::get_if<ir::IsNull>(&bare->node))
      if (const auto* use = std::get_if<ir::VariableUse>(&null->value->node))
        return (inner == nullptr ? "not given " : "given ") + state_.names[use->variable];
    if (inner != nullptr) {
      const std::string text = this->condition(inner->inner, kNot);
      return text.empty() ? "" : "not " + text;
    }
    refuse("this condition", "write it as a comparison of values");
    return "";
  }

private:
  Printed refuse(const std::string& what, const std::string& remedy) {
    state_.refuse(range_, what, remedy);
    return {};
  }

  Printed called(std::string_view name, const ir::ExpressionPtr& operand, ir::Kind want) {
    const Printed inner = value(operand, want);
    return {inner.text.empty() ? "" : fmt::format("{}({})", name, inner.text), kFactor};
  }

  Printed unaryText(const ir::Unary& unary, ir::Kind want) {
    const ir::Kind own = kindOf(state_, unary.operand);
    const ir::Kind kept = own == ir::Kind::Number ? want : own;
    switch (unary.op) {
    case ir::UnaryOp::Negate: {
      const std::string text = bracketed(value(unary.operand, kept), kFactor);
      return {text.empty() ? "" : "-" + text, kProduct};
    }
    case ir::UnaryOp::Absolute: return called("abs", unary.operand, kept);
    case ir::UnaryOp::Round: return called("round", unary.operand, kept);
    case ir::UnaryOp::SquareRoot: return called("sqrt", unary.operand, ir::Kind::Number);
    case ir::UnaryOp::Sine: return called("sin", unary.operand, ir::Kind::Angle);
    case ir::UnaryOp::Cosine: return called("cos", unary.operand, ir::Kind::Angle);
    case ir::UnaryOp::Tangent: return called("tan", unary.operand, ir::Kind::Angle);
    case ir::UnaryOp::ArcSine: return called("asin", unary.operand, ir::Kind::Number);
    case ir::UnaryOp::ArcCosine: return called("acos", unary.operand, ir::Kind::Number);
    case ir::UnaryOp::ArcTangent: return called("atan", unary.operand, ir::Kind::Number);
    case ir::UnaryOp::NullAsZero: return value(unary.operand, want);
    case ir::UnaryOp::Truncate:
    case ir::UnaryOp::RoundUp:
      return refuse("rounding toward or away from zero", "write `down` or `up`, which do the same on both "
                                                         "sides of zero, where the sign is certain");
    case ir::UnaryOp::Logarithm:
    case ir::UnaryOp::Exponential:
      return refuse("a logarithm or an exponential", "compute it outside of the cycle");
    case ir::UnaryOp::RoundIncrement:
    case ir::UnaryOp::FromBcd:
    case ir::UnaryOp::ToBcd:
    case ir::UnaryOp::AddPoint: break;
    }
    return refuse("a function of one control alone", "write what it means");
  }

  Printed binaryText(const ir::Binary& binary, ir::Kind want) {
    const ir::Kind left = kindOf(state_, binary.left), right = kindOf(state_, binary.right);
    switch (binary.op) {
    case ir::BinaryOp::Add:
    case ir::BinaryOp::Subtract: {
      const ir::Kind kind = left != ir::Kind::Number ? left : right != ir::Kind::Number ? right : want;
      // Of `a + -b` the difference.
      const auto* negated = std::get_if<ir::Unary>(&binary.right->node);
      const bool less = negated != nullptr && negated->op == ir::UnaryOp::Negate;
      if (less) {
        const bool turned = binary.op == ir::BinaryOp::Add;
        const ir::Binary plain{turned ? ir::BinaryOp::Subtract : ir::BinaryOp::Add, binary.left,
                               negated->operand};
        return binaryText(plain, want);
      }
      if (const ir::ExpressionPtr plain = withoutSign(binary.right)) {
        const bool turned = binary.op == ir::BinaryOp::Add; // of `a + -b / 2` the difference
        return binaryText({turned ? ir::BinaryOp::Subtract : ir::BinaryOp::Add, binary.left, plain}, want);
      }
      const bool minus = binary.op == ir::BinaryOp::Subtract;
      // Of `0 * pitch_x + y` the rest.
      if (isNothing(binary.right) && !isNothing(binary.left)) return value(binary.left, kind);
      if (isNothing(binary.left) && !isNothing(binary.right)) {
        if (!minus) return value(binary.right, kind);
        const std::string turned = bracketed(value(binary.right, kind), kFactor);
        return {turned.empty() ? "" : "-" + turned, kProduct};
      }
      const std::string a = bracketed(value(binary.left, kind), kSum);
      const std::string b = bracketed(value(binary.right, kind), minus ? kProduct : kSum);
      if (a.empty() || b.empty()) return {};
      return {a + (minus ? " - " : " + ") + b, kSum};
    }
    case ir::BinaryOp::Multiply: {
      if (isNothing(binary.left) || isNothing(binary.right))
        return {literal(0, isDimension(left) ? left : isDimension(right) ? right : want), kFactor};
      if (isOne(binary.left)) return value(binary.right, want);
      if (isOne(binary.right)) return value(binary.left, want);
      // The one that is a dimension keeps it; of two numbers the second gets that of the place.
      ir::Kind a = left, b = right;
      if (!isDimension(left) && !isDimension(right) && isDimension(want)) {
        const bool second = std::holds_alternative<ir::Constant>(binary.right->node) ||
                            !std::holds_alternative<ir::Constant>(binary.left->node);
        (second ? b : a) = want;
      }
      return product(value(binary.left, a), " * ", value(binary.right, b), kProduct);
    }
    case ir::BinaryOp::Divide: {
      const bool whole = left == ir::Kind::Number && right == ir::Kind::Number && isDimension(want);
      return product(value(binary.left, whole ? want : left), " / ", value(binary.right, right), kFactor);
    }
    case ir::BinaryOp::Direction: {
      // The angle of a vector: its parts in the order of the language.
      const Printed x = value(binary.left, ir::Kind::Length), y = value(binary.right, ir::Kind::Length);
      if (y.text.empty() || x.text.empty()) return {};
      return {fmt::format("atan({}, {})", y.text, x.text), kFactor};
    }
    case ir::BinaryOp::ValueOr:
      return refuse("a value that counts where another is missing", "write `if given NAME`");
    case ir::BinaryOp::Modulo:
    case ir::BinaryOp::Power:
    case ir::BinaryOp::Bearing:
    case ir::BinaryOp::BitAnd:
    case ir::BinaryOp::BitOr:
    case ir::BinaryOp::BitXor:
    case ir::BinaryOp::RoundedAnd:
    case ir::BinaryOp::RoundedOr:
    case ir::BinaryOp::RoundedXor:
    case ir::BinaryOp::RoundedModulo: break;
    }
    return refuse("a remainder, a power or bits", "the cycle language has sums, products, roots and angles");
  }

  // `b / 2` of `-b / 2`; a null pointer: no sign leads it.
  static ir::ExpressionPtr withoutSign(const ir::ExpressionPtr& value) {
    const auto* binary = std::get_if<ir::Binary>(&value->node);
    if (binary == nullptr || (binary->op != ir::BinaryOp::Multiply && binary->op != ir::BinaryOp::Divide))
      return nullptr;
    const auto* sign = std::get_if<ir::Unary>(&binary->left->node);
    const ir::ExpressionPtr left =
        sign != nullptr && sign->op == ir::UnaryOp::Negate ? sign->operand : withoutSign(binary->left);
    return left == nullptr ? nullptr : ir::binary(binary->op, left, binary->right);
  }
  static bool isOne(const ir::ExpressionPtr& value) {
    const double* constant = ir::constantValue(value);
    return constant != nullptr && *constant == 1;
  }
  // A product with a factor of 0. A written 0 is one that the source wants to be read.
  static bool isNothing(const ir::ExpressionPtr& value) {
    const auto* binary = std::get_if<ir::Binary>(&bare(value).node);
    if (binary == nullptr || binary->op != ir::BinaryOp::Multiply) return false;
    for (const ir::ExpressionPtr& side : {binary->left, binary->right}) {
      const double* constant = ir::constantValue(side);
      if ((constant != nullptr && *constant == 0) || isNothing(side)) return true;
    }
    return false;
  }

  static Printed product(const Printed& a, std::string_view sign, const Printed& b, int rightLeast) {
    const std::string left = bracketed(a, kProduct), right = bracketed(b, rightLeast);
    if (left.empty() || right.empty()) return {};
    return {left + std::string(sign) + right, kProduct};
  }

  std::string compared(const ir::Comparison& comparison) {
    const ir::Kind left = kindOf(state_, comparison.left), right = kindOf(state_, comparison.right);
    const ir::Kind kind = left != ir::Kind::Number ? left : right;
    const bool area = isArea(state_, comparison.left) || isArea(state_, comparison.right);
    // A whole number is one in both directions.
    const auto whole = [](const ir::ExpressionPtr& one, const ir::ExpressionPtr& other) {
      const auto* rounded = std::get_if<ir::Unary>(&one->node);
      return rounded != nullptr &&
             (rounded->op == ir::UnaryOp::Truncate || rounded->op == ir::UnaryOp::RoundUp) &&
             ir::equal(rounded->operand, other);
    };
    const bool equality =
        comparison.relation == ir::Relation::Equal || comparison.relation == ir::Relation::NotEqual ||
        comparison.relation == ir::Relation::Same || comparison.relation == ir::Relation::Different;
    const auto side = [&](const ir::ExpressionPtr& one) {
      const ir::ExpressionPtr& other = one == comparison.left ? comparison.right : comparison.left;
      const auto* use = std::get_if<ir::VariableUse>(&other->node);
      const auto names = use == nullptr ? state_.choices.end() : state_.choices.find(use->variable);
      if (const double* place = ir::constantValue(one); place != nullptr && names != state_.choices.end())
        return names->second[static_cast<std::size_t>(*place) - 1];
      if (equality && whole(one, other)) return called("down", other, kind).text;
      if (const double* zero = ir::constantValue(one); area && zero != nullptr && *zero == 0)
        return std::string("0");
      if (kind == ir::Kind::WorkOffset)
        if (const double* system = ir::constantValue(one)) return fmt::format("G{}", numberText(*system));
      return value(one, kind).text;
    };
    const std::string a = side(comparison.left), b = side(comparison.right);
    if (a.empty() || b.empty()) return "";
    switch (comparison.relation) {
    case ir::Relation::Equal:
    case ir::Relation::Same: return a + " is " + b;
    case ir::Relation::NotEqual:
    case ir::Relation::Different: return a + " is not " + b;
    case ir::Relation::Less: return a + " < " + b;
    case ir::Relation::Greater: return a + " > " + b;
    case ir::Relation::LessEqual: return a + " <= " + b;
    case ir::Relation::GreaterEqual: return a + " >= " + b;
    }
    return "";
  }

  State& state_;
  SourceRange range_;
};

} // namespace

const ir::Expression& bare(const ir::ExpressionPtr& value) {
  const auto* unary = std::get_if<ir::Unary>(&value->node);
  return unary != nullptr && unary->op == ir::UnaryOp::NullAsZero ? bare(unary->operand) : *value;
}

bool isArea(const State& state, const ir::ExpressionPtr& value) {
  if (const auto* unary = std::get_if<ir::Unary>(&value->node))
    return (unary->op == ir::UnaryOp::NullAsZero || ir::keepsKind(unary->op)) &&
           isArea(state, unary->operand);
  const auto* binary = std::get_if<ir::Binary>(&value->node);
  if (binary == nullptr) return false;
  if (binary->op == ir::BinaryOp::Multiply)
    return kindOf(state, binary->left) == ir::Kind::Length &&
           kindOf(state, binary->right) == ir::Kind::Length;
  return ir::addsKinds(binary->op) && (isArea(state, binary->left) || isArea(state, binary->right));
}

std::string literal(double value, ir::Kind kind, const std::string& digits) {
  std::string number = digits.empty() ? numberText(value) : digits;
  // `.5` and `5.` as one reads them, `+5` without its sign.
  if (number.starts_with('+')) number.erase(0, 1);
  const bool minus = number.starts_with('-');
  if (minus) number.erase(0, 1);
  if (number.starts_with('.')) number.insert(0, "0");
  if (number.find('.') != std::string::npos) {
    while (number.ends_with('0'))
      number.pop_back();
    if (number.ends_with('.')) number.pop_back();
  }
  if (minus && number != "0") number.insert(0, "-");
  switch (kind) {
  case ir::Kind::Length: return number + " mm";
  case ir::Kind::Angle: return number + " deg";
  case ir::Kind::Feed: return number + " mm/min";
  case ir::Kind::WorkOffset: return "G" + number;
  case ir::Kind::ToolOffset: return "T" + number;
  case ir::Kind::Flag: return value != 0 ? "yes" : "no";
  case ir::Kind::Number:
  case ir::Kind::Count:
  case ir::Kind::Ratio:
  case ir::Kind::Text: break;
  }
  return number;
}

ir::Kind kindOf(const State& state, const ir::ExpressionPtr& value) {
  if (const auto* result = std::get_if<ir::MeasuredResult>(&value->node)) {
    return result->name == ir::ResultName::Main ? ir::Kind::Length : ir::resultKind(result->name);
  }
  if (const auto* binary = std::get_if<ir::Binary>(&value->node)) {
    const ir::Kind left = kindOf(state, binary->left), right = kindOf(state, binary->right);
    if (binary->op == ir::BinaryOp::Multiply)
      return isDimension(left) ? left : isDimension(right) ? right : left;
    if (binary->op == ir::BinaryOp::Divide)
      return isDimension(left) && left == right ? ir::Kind::Ratio : left;
    if (ir::addsKinds(binary->op)) return left != ir::Kind::Number ? left : right;
  }
  if (const auto* unary = std::get_if<ir::Unary>(&value->node))
    if (unary->op == ir::UnaryOp::SquareRoot && isArea(state, unary->operand)) return ir::Kind::Length;
  if (const auto* unary = std::get_if<ir::Unary>(&value->node))
    if (unary->op == ir::UnaryOp::NullAsZero || ir::keepsKind(unary->op))
      return kindOf(state, unary->operand);
  return ir::kindOf(value, state.cycle, [](const ir::Expression&, ir::Kind, ir::Kind) {});
}

std::string valueText(State& state, const ir::ExpressionPtr& value, ir::Kind want, SourceRange range) {
  return Printer(state, range).value(value, want).text;
}

std::string conditionText(State& state, const ir::ConditionPtr& condition, SourceRange range) {
  return Printer(state, range).condition(condition);
}

std::string systemText(State& state, const ir::ExpressionPtr& system, SourceRange range) {
  constexpr double kLast = 59;
  if (const double* number = ir::constantValue(system)) {
    if (*number > kLast) state.refuse(range, "a work offset beyond G54 to G59", "take one of those");
    return "G" + numberText(*number);
  }
  if (const auto* use = std::get_if<ir::VariableUse>(&system->node)) return state.names[use->variable];
  if (const auto* sum = std::get_if<ir::Binary>(&system->node); sum && sum->op == ir::BinaryOp::Add)
    for (const auto& [one, other] : {std::pair(sum->left, sum->right), std::pair(sum->right, sum->left)}) {
      const auto* use = std::get_if<ir::VariableUse>(&one->node);
      const double* by = ir::constantValue(other);
      const auto shift = use == nullptr ? state.shifts.end() : state.shifts.find(use->variable);
      if (by != nullptr && shift != state.shifts.end() && shift->second == *by)
        return state.names[use->variable];
    }
  state.refuse(range, "a work offset that is computed", "make it a parameter of the cycle");
  return "";
}

} // namespace dotek::backends::cycle
