#include "frontend/gibbs/Assumptions.h"
#include "frontend/gibbs/Interpreter.h"
#include "support/messages/Gibbs.h"

namespace dotek::frontend::gibbs {
namespace {

constexpr std::size_t kMaxName = 32; // characters of a name, without `$`

ir::ConditionPtr conditionOf(const Truth& truth, SourceRange range) {
  const bool* known = std::get_if<bool>(&truth);
  return known != nullptr ? ir::truth(*known, range) : std::get<ir::ConditionPtr>(truth);
}

Truth join(ir::Connective op, const Truth& a, const Truth& b, SourceRange range) {
  const bool* first = std::get_if<bool>(&a);
  const bool* second = std::get_if<bool>(&b);
  if (first == nullptr || second == nullptr)
    return ir::join(op, conditionOf(a, range), conditionOf(b, range), range);
  return op == ir::Connective::And ? *first && *second : *first || *second;
}

// What a message calls the first that is not known; "" where all are.
std::string reasonOf(const std::vector<Value>& values) {
  for (const Value& value : values)
    if (const Unknown* unknown = unknownIn(value)) return unknownText(*unknown);
  return "";
}

} // namespace

bool Interpreter::assumes(std::string_view assumption, SourceRange range) {
  if (around_.assumptions.contains(std::string(assumption))) return true;
  const Assumption* entry = findAssumption(assumption);
  fault<diag::UnverifiedConstructRun>(range, false, entry != nullptr ? entry->construct : "this", assumption);
  return false;
}

std::optional<Value> Interpreter::computed(ir::Computed result, SourceRange range) {
  if (result.ok()) return Value(result.value);
  if (result.error == ir::ArithmeticError::DivisionByZero) {
    fault<diag::DivisionByZero>(range, true);
  } else {
    fault<diag::DomainError>(range, true, ir::describe(result.error));
  }
  return std::nullopt;
}

std::optional<Value> Interpreter::evaluateNumber(State& state, const Expression& e) {
  auto value = evaluate(state, e);
  if (!value || !isTextValue(*value)) return value;
  fault<diag::KindMismatchRun>(e.range, false, "a text", "a number");
  return std::nullopt;
}

std::optional<Value> Interpreter::evaluateText(State& state, const Expression& e) {
  auto value = evaluate(state, e);
  if (!value || isTextValue(*value)) return value;
  fault<diag::KindMismatchRun>(e.range, false, "a number", "a text");
  return std::nullopt;
}

std::optional<Value> Interpreter::evaluate(State& state, const Expression& e) {
  return std::visit([&](const auto& node) { return evaluate(state, node, e.range); }, e.node);
}

std::optional<Value> Interpreter::evaluate(State& state, const VariableRef& ref, SourceRange) {
  return read(state, ref);
}

std::optional<Value> Interpreter::evaluate(State& state, const Bracketed& node, SourceRange) {
  return evaluate(state, *node.inner);
}

std::optional<Value> Interpreter::evaluate(State&, const ErrorExpression&, SourceRange range) {
  refuse(range, "the expression is broken");
  return std::nullopt;
}

std::optional<Value> Interpreter::evaluate(State& state, const Unary& node, SourceRange range) {
  const auto operand = evaluateNumber(state, *node.operand);
  if (!operand || node.op == UnaryOperator::Plus) return operand;
  auto negated = apply(state, kNegation, {*operand}, range);
  if (negated || fault_) return negated;
  return opaque(state, "-(" + canonical(*operand) + ")", {*operand}, reasonOf({*operand}), false, range);
}

std::optional<Value> Interpreter::evaluate(State&, const NumberLiteral& literal, SourceRange range) {
  const std::string& digits = literal.text;
  const bool exponent = digits.find_first_of("eE") != std::string::npos;
  const bool bare = !digits.empty() && (digits.front() == '.' || digits.back() == '.');
  if (exponent && !assumes("exponent", range)) return std::nullopt;
  if (bare && !assumes("bare-fraction", range)) return std::nullopt;
  const auto value = computed(ir::add(literal.value, 0), range);
  if (!value) return std::nullopt;
  return this->literal(std::get<double>(*value), exponent || bare ? "" : digits, range);
}

std::optional<Value> Interpreter::evaluate(State&, const TextLiteral& literal, SourceRange range) {
  if (literal.quote == '\'' && !assumes("single-quotes", range)) return std::nullopt;
  std::string text = literal.text;
  for (std::size_t at = text.find("\"\""); literal.quote == '"' && at != std::string::npos;
       at = text.find("\"\"", at + 1)) {
    if (!assumes("doubled-quote", range)) return std::nullopt;
    text.erase(at, 1);
  }
  return Value(std::move(text));
}

std::optional<Value> Interpreter::evaluate(State& state, const Binary& node, SourceRange range) {
  const auto left = evaluate(state, *node.left);
  if (!left) return std::nullopt;
  const auto right = evaluate(state, *node.right);
  if (!right) return std::nullopt;
  if (isTextValue(*left) != isTextValue(*right) || (isTextValue(*left) && node.op != BinaryOperator::Add)) {
    const SourceRange text = isTextValue(*left) ? node.left->range : node.right->range;
    fault<diag::KindMismatchRun>(text, false, "a text", "a number");
    return std::nullopt;
  }
  if (!isTextValue(*left)) {
    auto result = combine(state, node, *left, *right, range);
    if (result || fault_) return result;
    constexpr const char* kSigns[] = {"+", "-", "*", "/"};
    const std::string symbol =
        fmt::format("({}){}({})", canonical(*left), kSigns[static_cast<int>(node.op)], canonical(*right));
    return opaque(state, symbol, {*left, *right}, reasonOf({*left, *right}), false, range);
  }
  if (!assumes("text-join", range)) return std::nullopt;
  const auto* a = std::get_if<std::string>(&*left);
  const auto* b = std::get_if<std::string>(&*right);
  if (a == nullptr || b == nullptr) {
    return opaque(state, canonical(*left) + "&" + canonical(*right), {*left, *right},
                  reasonOf({*left, *right}), true, range);
  }
  if (a->size() + b->size() <= around_.limits.textLength) return Value(*a + *b);
  fault<diag::TextOverflow>(range, false, around_.limits.textLength);
  return std::nullopt;
}

std::optional<Value> Interpreter::evaluate(State& state, const FunctionCall& call, SourceRange range) {
  const std::string name = foldCase(call.name.text);
  const stdlib::FunctionSpec* spec = around_.keywords.function(name);
  const bool givesText = spec != nullptr ? spec->result == 't' : call.name.isText();
  std::vector<Value> arguments;
  for (const ExpressionPtr& argument : call.arguments) {
    auto value = evaluate(state, *argument);
    if (!value) return std::nullopt;
    arguments.push_back(std::move(*value));
  }
  if (spec != nullptr && !spec->types.empty()) {
    if (spec->types.size() != arguments.size()) {
      refuse(range, "the function takes another number of values");
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
  const NumberFunction* numeric = numberFunction(name);
  const bool usesAngle = numeric != nullptr && numeric->angle != NumberFunction::Angle::None;
  if (usesAngle && !state.angles) {
    const bool degrees = around_.assumptions.contains("angle-degrees");
    if (degrees == around_.assumptions.contains("angle-radians")) {
      fault<diag::AngleUnitOpen>(call.name.range, false, call.name.text);
      return std::nullopt;
    }
    state.angles = degrees ? ir::AngleUnit::Degrees : ir::AngleUnit::Radians;
  }
  bool numbers = true;
  for (const Value& value : arguments)
    numbers = numbers && !isTextValue(value);
  if (numeric != nullptr && numbers && arguments.size() == numeric->arity()) {
    auto result = apply(state, *numeric, arguments, range);
    if (result || fault_) return result;
  } else {
    const TextResult result = textFunction(name, arguments);
    if (result.value) return result.value;
    if (!result.error.empty()) {
      fault<diag::DomainError>(range, true, result.error);
      return std::nullopt;
    }
  }
  std::string symbol = name + "(";
  for (const Value& value : arguments)
    symbol += canonical(value) + ",";
  if (usesAngle) symbol += *state.angles == ir::AngleUnit::Degrees ? "degrees" : "radians";
  const std::string reason = reasonOf(arguments);
  return opaque(state, symbol + ")", arguments, reason.empty() ? call.name.text : reason, givesText, range);
}

// ---- variables ------------------------------------------------------------------------------------------

bool Interpreter::isOfCam(const std::string& key) const {
  return key.starts_with("CALLBACK_") || around_.keywords.isSystemVariable(key) ||
         around_.keywords.isConstant(key);
}

std::optional<std::string> Interpreter::keyOf(State& state, const VariableRef& ref, bool reads) {
  std::string key = foldCase(ref.name.text);
  if (key.size() > kMaxName + (ref.name.isText() ? 1 : 0) && !assumes("long-name", ref.name.range))
    return std::nullopt;
  if (!ref.index) return key;
  if (!assumes(ref.bracket == '[' ? "array-square" : "array-round", ref.name.range)) return std::nullopt;
  return element(state, key, ref, reads);
}

std::optional<Value> Interpreter::read(State& state, const VariableRef& ref) {
  const auto key = keyOf(state, ref, true);
  if (!key) return std::nullopt;
  const bool text = ref.name.isText();
  if (auto value = lookUp(state, *key, ref)) return value;
  if (!ref.index && !state.frames.back().locals.contains(*key) && isOfCam(*key)) {
    // Each read of a cursor gives another element.
    const bool cursor = key->starts_with("NEXT_") && around_.keywords.isSystemVariable(*key);
    return opaque(state, cursor ? "" : *key, {}, *key, text, ref.name.range);
  }
  if (around_.assumptions.contains("unset-zero")) return text ? Value(std::string()) : Value(0.0);
  if (lenient_) return opaque(state, "", {}, ref.name.text, text, ref.name.range);
  fault<diag::ReadBeforeSet>(ref.name.range, false, ref.name.text);
  return std::nullopt;
}

bool Interpreter::write(State& state, const VariableRef& ref, Value value, SourceRange range) {
  const bool text = isTextValue(value);
  if (text != ref.name.isText()) {
    fault<diag::KindMismatchRun>(ref.name.range, false, text ? "a text" : "a number",
                                 text ? "a number" : "a text");
    return false;
  }
  const auto key = keyOf(state, ref, false);
  if (!key) return false;
  if (const auto* known = std::get_if<std::string>(&value);
      known != nullptr && known->size() > around_.limits.textLength) {
    fault<diag::TextOverflow>(ref.name.range, false, around_.limits.textLength);
    return false;
  }
  const bool own = isField(*key) || *key == "CALLBACK_RETURNCODE" || !isOfCam(*key);
  if (!own && !state.frames.back().locals.contains(*key)) {
    fault<diag::SystemNameWritten>(ref.name.range, false, ref.name.text);
    return false;
  }
  return store(state, *key, ref, std::move(value), range);
}

// ---- conditions -----------------------------------------------------------------------------------------

std::optional<Truth> Interpreter::decide(State& state, const Condition& condition) {
  if (!condition.connectives.empty() && !assumes("and-or", condition.range)) return std::nullopt;
  // AND binds tighter than OR; all comparisons are evaluated.
  std::optional<Truth> any;
  std::optional<Truth> all;
  const auto close = [&] {
    any = any ? join(ir::Connective::Or, *any, *all, condition.range) : *all;
    all.reset();
  };
  for (std::size_t i = 0; i < condition.comparisons.size(); ++i) {
    const auto here = decide(state, condition.comparisons[i]);
    if (!here) return std::nullopt;
    if (i > 0 && condition.connectives[i - 1] == Connective::Or) close();
    all = all ? join(ir::Connective::And, *all, *here, condition.range) : *here;
  }
  if (all) close();
  return any;
}

std::optional<Truth> Interpreter::decide(State& state, const Comparison& c) {
  if (!c.nots.empty() && !assumes("not", c.nots.front())) return std::nullopt;
  if (!c.brackets.empty() && !assumes("condition-brackets", c.brackets.front())) return std::nullopt;
  if (!c.left || !c.right) {
    refuse(c.range, "the condition is broken");
    return std::nullopt;
  }
  const auto left = evaluate(state, *c.left);
  if (!left) return std::nullopt;
  const auto right = evaluate(state, *c.right);
  if (!right) return std::nullopt;
  if (isTextValue(*left) != isTextValue(*right)) {
    fault<diag::KindMismatchRun>(c.range, false, "a text", "a number");
    return std::nullopt;
  }
  std::optional<Truth> holds;
  if (!isTextValue(*left)) {
    holds = compareNumbers(state, c, *left, *right);
  } else if (c.relation != Relation::Equal && c.relation != Relation::NotEqual) {
    refuse(c.range, "which of two texts is the greater one is not documented");
  } else {
    const auto* a = std::get_if<std::string>(&*left);
    const auto* b = std::get_if<std::string>(&*right);
    if (a == nullptr || b == nullptr) {
      holds = compareTexts(state, c, *left, *right);
    } else {
      if (*a != *b && foldCase(*a) == foldCase(*b) && !assumes("text-comparison", c.range))
        return std::nullopt;
      holds = (*a == *b) == (c.relation == Relation::Equal);
    }
  }
  if (!holds || c.nots.size() % 2 == 0) return holds;
  if (const bool* known = std::get_if<bool>(&*holds)) return !*known;
  return ir::negate(std::get<ir::ConditionPtr>(*holds));
}

} // namespace dotek::frontend::gibbs
