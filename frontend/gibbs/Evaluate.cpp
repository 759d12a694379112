#include "frontend/gibbs/Assumptions.h"
#include "frontend/gibbs/RunMachine.h"
#include "support/messages/Gibbs.h"

#include <cmath>

namespace dotek::frontend::gibbs {
namespace {

constexpr std::size_t kMaxSymbol = 200; // bytes; longer names of unknowns are replaced by a number

// Characters of a name, without `$`.
constexpr std::size_t kMaxName = 32;

} // namespace

bool Machine::assumes(std::string_view assumption, SourceRange range) {
  if (context_.assumptions.contains(std::string(assumption))) return true;
  const Assumption* entry = findAssumption(assumption);
  fault<diag::UnverifiedConstructRun>(range, false, entry != nullptr ? entry->construct : "this", assumption);
  return false;
}

Value Machine::opaque(State& state, std::string name, const std::vector<Value>& from,
                      const std::string& reason, bool text) {
  const bool own = name.empty() || name.size() > kMaxSymbol;
  return opaqueValue(own ? Symbol::fresh(++state.fresh) : Symbol::named(std::move(name)), sourcesOf(from),
                     reason, text);
}

std::optional<Value> Machine::computed(ir::Computed result, SourceRange range) {
  if (result.ok()) return Value(result.value);
  if (result.error == ir::ArithmeticError::DivisionByZero) {
    fault<diag::DivisionByZero>(range, true);
  } else {
    fault<diag::DomainError>(range, true, ir::describe(result.error));
  }
  return std::nullopt;
}

std::optional<Value> Machine::evaluateNumber(State& state, const Expression& e) {
  auto value = evaluate(state, e);
  if (!value || !isTextValue(*value)) return value;
  fault<diag::KindMismatchRun>(e.range, false, "a text", "a number");
  return std::nullopt;
}

std::optional<Value> Machine::evaluateText(State& state, const Expression& e) {
  auto value = evaluate(state, e);
  if (!value || isTextValue(*value)) return value;
  fault<diag::KindMismatchRun>(e.range, false, "a number", "a text");
  return std::nullopt;
}

std::optional<Value> Machine::evaluate(State& state, const Expression& e) {
  if (const auto* number = std::get_if<NumberLiteral>(&e.node)) {
    const std::string& text = number->text;
    if (text.find_first_of("eE") != std::string::npos && !assumes("exponent", e.range)) return std::nullopt;
    if (!text.empty() && (text.front() == '.' || text.back() == '.') && !assumes("bare-fraction", e.range)) {
      return std::nullopt;
    }
    return computed(ir::add(number->value, 0), e.range);
  }
  if (const auto* literal = std::get_if<TextLiteral>(&e.node)) {
    if (literal->quote == '\'' && !assumes("single-quotes", e.range)) return std::nullopt;
    std::string text = literal->text;
    for (std::size_t at = text.find("\"\""); literal->quote == '"' && at != std::string::npos;
         at = text.find("\"\"", at + 1)) {
      if (!assumes("doubled-quote", e.range)) return std::nullopt;
      text.erase(at, 1);
    }
    return Value(std::move(text));
  }
  if (const auto* variable = std::get_if<VariableRef>(&e.node)) return read(state, *variable);
  if (const auto* call = std::get_if<FunctionCall>(&e.node)) return function(state, *call, e.range);
  if (const auto* unary = std::get_if<Unary>(&e.node)) {
    const auto operand = evaluateNumber(state, *unary->operand);
    if (!operand || unary->op == UnaryOperator::Plus) return operand;
    if (const double* number = std::get_if<double>(&*operand))
      return computed(ir::subtract(0, *number), e.range);
    return linear(*operand, -1, 0.0, 0);
  }
  if (const auto* node = std::get_if<Binary>(&e.node)) return binary(state, *node, e.range);
  if (const auto* bracketed = std::get_if<Bracketed>(&e.node)) return evaluate(state, *bracketed->inner);
  fault<diag::CannotRun>(e.range, false, "the expression is broken");
  return std::nullopt;
}

std::optional<Value> Machine::binary(State& state, const Binary& node, SourceRange range) {
  const auto left = evaluate(state, *node.left);
  if (!left) return std::nullopt;
  const auto right = evaluate(state, *node.right);
  if (!right) return std::nullopt;
  if (isTextValue(*left) != isTextValue(*right) || (isTextValue(*left) && node.op != BinaryOperator::Add)) {
    const SourceRange text = isTextValue(*left) ? node.left->range : node.right->range;
    fault<diag::KindMismatchRun>(text, false, "a text", "a number");
    return std::nullopt;
  }
  if (isTextValue(*left)) {
    if (!assumes("text-join", range)) return std::nullopt;
    const auto* a = std::get_if<std::string>(&*left);
    const auto* b = std::get_if<std::string>(&*right);
    if (a == nullptr || b == nullptr) {
      const Unknown& unknown = *unknownIn(a == nullptr ? *left : *right);
      return opaque(state, canonical(*left) + "&" + canonical(*right), {*left, *right}, unknown.reason, true);
    }
    if (a->size() + b->size() <= context_.limits.textLength) return Value(*a + *b);
    fault<diag::TextOverflow>(range, false, context_.limits.textLength);
    return std::nullopt;
  }
  const double* a = std::get_if<double>(&*left);
  const double* b = std::get_if<double>(&*right);
  if (a != nullptr && b != nullptr) {
    switch (node.op) {
    case BinaryOperator::Add: return computed(ir::add(*a, *b), range);
    case BinaryOperator::Subtract: return computed(ir::subtract(*a, *b), range);
    case BinaryOperator::Multiply: return computed(ir::multiply(*a, *b), range);
    case BinaryOperator::Divide: return computed(ir::divide(*a, *b), range);
    }
  }
  if (node.op == BinaryOperator::Divide && b != nullptr && *b == 0) return computed(ir::divide(1, 0), range);
  std::optional<Value> form;
  if (node.op == BinaryOperator::Add) form = linear(*left, 1, *right, 1);
  if (node.op == BinaryOperator::Subtract) form = linear(*left, 1, *right, -1);
  if (node.op == BinaryOperator::Multiply && a != nullptr) form = linear(*right, *a, 0.0, 0);
  if (node.op == BinaryOperator::Multiply && b != nullptr) form = linear(*left, *b, 0.0, 0);
  if (node.op == BinaryOperator::Divide && b != nullptr) form = linear(*left, 1 / *b, 0.0, 0);
  if (form) return form;
  constexpr const char* kSigns[] = {"+", "-", "*", "/"};
  const Unknown& unknown = *unknownIn(a == nullptr ? *left : *right);
  const std::string symbol =
      fmt::format("({}){}({})", canonical(*left), kSigns[static_cast<int>(node.op)], canonical(*right));
  return opaque(state, symbol, {*left, *right}, unknown.reason, false);
}

// ---- variables ------------------------------------------------------------------------------------------

std::optional<std::string> Machine::keyOf(State& state, const VariableRef& ref) {
  std::string key = foldCase(ref.name.text);
  if (key.size() > kMaxName + (ref.name.isText() ? 1 : 0) && !assumes("long-name", ref.name.range)) {
    return std::nullopt;
  }
  if (!ref.index) return key;
  if (!assumes(ref.bracket == '[' ? "array-square" : "array-round", ref.name.range)) return std::nullopt;
  const auto index = evaluateNumber(state, *ref.index);
  if (!index) return std::nullopt;
  const double* number = std::get_if<double>(&*index);
  const auto size = state.arrays.find(key);
  if (number == nullptr) {
    fault<diag::UnknownValue>(ref.index->range, false, unknownText(*unknownIn(*index)));
    return std::nullopt;
  }
  if (size == state.arrays.end() || *number != std::floor(*number) || *number < 1 ||
      *number > static_cast<double>(size->second)) {
    fault<diag::CannotRun>(ref.index->range, false, "the array has no such element");
    return std::nullopt;
  }
  return key + "(" + std::to_string(static_cast<std::size_t>(*number)) + ")";
}

std::optional<Value> Machine::read(State& state, const VariableRef& ref) {
  const auto key = keyOf(state, ref);
  if (!key) return std::nullopt;
  const Frame& frame = state.frames.back();
  const auto local = frame.locals.find(*key);
  if (local != frame.locals.end() && local->second) return local->second;
  if (local == frame.locals.end()) {
    const auto global = state.globals.find(*key);
    if (global != state.globals.end()) return global->second;
    if (!ref.index) return readUnassigned(state, *key, ref.name);
  }
  if (context_.assumptions.contains("unset-zero"))
    return ref.name.isText() ? Value(std::string()) : Value(0.0);
  if (lenient_) return opaque(state, "", {}, ref.name.text, ref.name.isText());
  fault<diag::ReadBeforeSet>(ref.name.range, false, ref.name.text);
  return std::nullopt;
}

std::optional<Value> Machine::readUnassigned(State& state, const std::string& key, const Name& name) {
  const auto& keywords = context_.keywords;
  // Each read of a cursor gives another element.
  if (key.starts_with("NEXT_") && keywords.isSystemVariable(key))
    return opaque(state, "", {}, key, name.isText());
  if (key.starts_with("CALLBACK_") || keywords.isSystemVariable(key) || keywords.isConstant(key)) {
    return opaque(state, key, {}, key, name.isText());
  }
  if (context_.assumptions.contains("unset-zero")) return name.isText() ? Value(std::string()) : Value(0.0);
  if (lenient_) return opaque(state, "", {}, name.text, name.isText());
  fault<diag::ReadBeforeSet>(name.range, false, name.text);
  return std::nullopt;
}

bool Machine::write(State& state, const VariableRef& ref, Value value) {
  if (isTextValue(value) != ref.name.isText()) {
    fault<diag::KindMismatchRun>(ref.name.range, false, isTextValue(value) ? "a text" : "a number",
                                 ref.name.isText() ? "a text" : "a number");
    return false;
  }
  const auto key = keyOf(state, ref);
  if (!key) return false;
  if (const auto* text = std::get_if<std::string>(&value);
      text != nullptr && text->size() > context_.limits.textLength) {
    fault<diag::TextOverflow>(ref.name.range, false, context_.limits.textLength);
    return false;
  }
  Frame& frame = state.frames.back();
  if (const auto local = frame.locals.find(*key); local != frame.locals.end()) {
    local->second = std::move(value);
    return true;
  }
  const bool isReturnCode = *key == "CALLBACK_RETURNCODE";
  const bool isSystem = key->starts_with("CALLBACK_") || context_.keywords.isSystemVariable(*key) ||
                        context_.keywords.isConstant(*key);
  if (isSystem && !isReturnCode && !context_.fields.contains(*key)) {
    fault<diag::SystemNameWritten>(ref.name.range, false, ref.name.text);
    return false;
  }
  if (isReturnCode) state.returnCodeSet = place_;
  if (context_.fields.contains(*key)) state.fieldSet[*key] = place_;
  state.globals[*key] = std::move(value);
  return true;
}

// ---- conditions -----------------------------------------------------------------------------------------

std::optional<bool> Machine::decide(State& state, const Condition& condition) {
  if (!condition.connectives.empty() && !assumes("and-or", condition.range)) return std::nullopt;
  // AND binds tighter than OR; all comparisons are evaluated.
  bool any = false;
  bool all = true;
  for (std::size_t i = 0; i < condition.comparisons.size(); ++i) {
    const auto holdsHere = decide(state, condition.comparisons[i]);
    if (!holdsHere) return std::nullopt;
    if (i > 0 && condition.connectives[i - 1] == Connective::Or) {
      any = any || all;
      all = true;
    }
    all = all && *holdsHere;
  }
  return any || all;
}

std::optional<bool> Machine::decide(State& state, const Comparison& comparison) {
  if (!comparison.nots.empty() && !assumes("not", comparison.nots.front())) return std::nullopt;
  if (!comparison.brackets.empty() && !assumes("condition-brackets", comparison.brackets.front()))
    return std::nullopt;
  if (!comparison.left || !comparison.right) {
    fault<diag::CannotRun>(comparison.range, false, "the condition is broken");
    return std::nullopt;
  }
  const auto left = evaluate(state, *comparison.left);
  if (!left) return std::nullopt;
  const auto right = evaluate(state, *comparison.right);
  if (!right) return std::nullopt;
  const auto result = compare(state, *left, comparison.relation, *right, comparison.range);
  if (!result) return std::nullopt;
  return *result != (comparison.nots.size() % 2 == 1);
}

std::optional<bool> Machine::compare(State& state, const Value& left, Relation relation, const Value& right,
                                     SourceRange range) {
  if (isTextValue(left) != isTextValue(right)) {
    fault<diag::KindMismatchRun>(range, false, "a text", "a number");
    return std::nullopt;
  }
  Question question;
  if (isTextValue(left)) {
    if (relation != Relation::Equal && relation != Relation::NotEqual) {
      fault<diag::CannotRun>(range, false, "which of two texts is the greater one is not documented");
      return std::nullopt;
    }
    const auto* a = std::get_if<std::string>(&left);
    const auto* b = std::get_if<std::string>(&right);
    if (a != nullptr && b != nullptr) {
      if (*a != *b && foldCase(*a) == foldCase(*b) && !assumes("text-comparison", range)) return std::nullopt;
      return (*a == *b) == (relation == Relation::Equal);
    }
    const std::string leftText = canonical(left);
    const std::string rightText = canonical(right);
    if (leftText == rightText) return relation == Relation::Equal;
    const Unknown& unknown = *unknownIn(a == nullptr ? left : right);
    question = {std::min(leftText, rightText) + " is " + std::max(leftText, rightText),
                relation,
                0,
                sourcesOf({left, right}),
                unknown.reason,
                range};
  } else {
    const double* a = std::get_if<double>(&left);
    const double* b = std::get_if<double>(&right);
    if (a != nullptr && b != nullptr) return holds(*a, relation, *b);
    const auto form = linear(left, 1, right, -1);
    const Value difference = form ? *form : opaque(state, "", {left, right}, "an unknown value", false);
    const Unknown* unknown = unknownIn(difference);
    if (unknown == nullptr) return holds(std::get<double>(difference), relation, 0);
    question = questionOf(*unknown, relation, range);
  }
  const auto learnt = state.learnt.find(question.key);
  const Range known = learnt == state.learnt.end() ? Range() : learnt->second;
  if (!known.canBe(opposite(question.relation), question.bound)) return true;
  if (!known.canBe(question.relation, question.bound)) return false;
  question_ = std::move(question);
  return std::nullopt;
}

std::optional<bool> Machine::isNonZero(State& state, const Value& value, SourceRange range) {
  return compare(state, value, Relation::NotEqual, 0.0, range);
}

} // namespace dotek::frontend::gibbs
