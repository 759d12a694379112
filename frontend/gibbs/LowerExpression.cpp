#include "frontend/gibbs/Assumptions.h"
#include "frontend/gibbs/LowerFlatten.h"
#include "stdlib/HostInputs.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace dotek::frontend::gibbs {
namespace {

constexpr std::size_t kMaxName = 32; // characters of a name, without `$`

bool isText(const Lowered& value) {
  return !value.number && isTextValue(value.fixed);
}

// The host input that the value is, "" for any other.
std::string hostOf(const Value& value) {
  const Symbol* symbol = symbolIn(value);
  const bool host =
      symbol != nullptr && symbol->kind == Symbol::Kind::Host && stdlib::isHostInput(symbol->name);
  return host ? symbol->name : "";
}

// Data of the CAM that no program can ask for.
bool isOpaque(const Lowered& value) {
  return !value.number && unknownIn(value.fixed) != nullptr && hostOf(value.fixed).empty();
}

// Only ever refused where it is used: the place tells it apart from others.
Value unknownAt(SourceRange range, const std::string& reason, bool text) {
  return opaqueValue(Symbol::place(range), {}, reason, text);
}

bool isAngleFunction(std::string_view name) {
  constexpr std::array<std::string_view, 7> kNames = {"SIN",  "COS",  "TAN",       "ASIN",
                                                      "ACOS", "ATAN", "ANGLE_LINE"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

ir::Relation relationOf(Relation relation) {
  switch (relation) {
  case Relation::Equal: return ir::Relation::Equal;
  case Relation::NotEqual: return ir::Relation::NotEqual;
  case Relation::Less: return ir::Relation::Less;
  case Relation::Greater: return ir::Relation::Greater;
  case Relation::LessEqual: return ir::Relation::LessEqual;
  case Relation::GreaterEqual: return ir::Relation::GreaterEqual;
  }
  return ir::Relation::Equal;
}

} // namespace

bool Flattener::assumes(std::string_view assumption, SourceRange range) {
  if (context_.assumptions.contains(std::string(assumption))) return true;
  const Assumption* entry = findAssumption(assumption);
  fail<diag::UnverifiedConstructRun>(range, entry != nullptr ? entry->construct : "this", assumption);
  return false;
}

bool Flattener::mayFail(const State& state, SourceRange range) {
  if (state.frames.back().onError == nullptr) return false;
  fail<diag::CannotTranslate>(range, "ON_ERROR stands around a computation that may fail");
  return true;
}

std::optional<ir::ExpressionPtr> Flattener::number(const Lowered& value, SourceRange range) {
  if (value.number) return value.number;
  if (const double* known = std::get_if<double>(&value.fixed)) return ir::constant(*known, range);
  if (isTextValue(value.fixed)) {
    fail<diag::KindMismatchRun>(range, "a text", "a number");
    return std::nullopt;
  }
  if (const std::string host = hostOf(value.fixed); !host.empty() && context_.host)
    return ir::variable(context_.host(host), range);
  fail<diag::CamValue>(range, unknownText(*unknownIn(value.fixed)));
  return std::nullopt;
}

std::optional<ir::ExpressionPtr> Flattener::lowerNumber(State& state, const Expression& e) {
  const auto value = lower(state, e);
  return value ? number(*value, e.range) : std::nullopt;
}

std::optional<Lowered> Flattener::lower(State& state, const Expression& e) {
  if (const auto* literal = std::get_if<NumberLiteral>(&e.node)) {
    const std::string& text = literal->text;
    const bool exponent = text.find_first_of("eE") != std::string::npos;
    const bool bare = !text.empty() && (text.front() == '.' || text.back() == '.');
    if (exponent && !assumes("exponent", e.range)) return std::nullopt;
    if (bare && !assumes("bare-fraction", e.range)) return std::nullopt;
    return Lowered{ir::constant(literal->value, e.range, exponent || bare ? "" : text)};
  }
  if (const auto* literal = std::get_if<TextLiteral>(&e.node)) {
    if (literal->quote == '\'' && !assumes("single-quotes", e.range)) return std::nullopt;
    std::string text = literal->text;
    for (std::size_t at = text.find("\"\""); literal->quote == '"' && at != std::string::npos;
         at = text.find("\"\"", at + 1)) {
      if (!assumes("doubled-quote", e.range)) return std::nullopt;
      text.erase(at, 1);
    }
    return Lowered{nullptr, std::move(text)};
  }
  if (const auto* variable = std::get_if<VariableRef>(&e.node)) {
    auto value = read(state, *variable);
    if (!value || !value->number) return value;
    auto placed = std::make_shared<ir::Expression>(*value->number);
    placed->range = e.range;
    return Lowered{std::move(placed)};
  }
  if (const auto* call = std::get_if<FunctionCall>(&e.node)) return function(state, *call, e.range);
  if (const auto* bracketed = std::get_if<Bracketed>(&e.node)) return lower(state, *bracketed->inner);
  if (const auto* node = std::get_if<Binary>(&e.node)) return binary(state, *node, e.range);
  const auto* unary = std::get_if<Unary>(&e.node);
  if (unary == nullptr) {
    fail<diag::CannotTranslate>(e.range, "the expression is broken");
    return std::nullopt;
  }
  auto operand = lower(state, *unary->operand);
  if (!operand) return std::nullopt;
  if (isText(*operand)) {
    fail<diag::KindMismatchRun>(unary->operand->range, "a text", "a number");
    return std::nullopt;
  }
  if (unary->op == UnaryOperator::Plus) return operand;
  if (isOpaque(*operand))
    return Lowered{nullptr, unknownAt(e.range, unknownText(*unknownIn(operand->fixed)), false)};
  const auto value = number(*operand, e.range);
  if (!value) return std::nullopt;
  const auto* constant = std::get_if<ir::Constant>(&(*value)->node);
  if (constant == nullptr) return Lowered{ir::unary(ir::UnaryOp::Negate, *value, e.range)};
  const std::string digits =
      constant->digits.empty() || constant->digits.front() == '-' ? "" : "-" + constant->digits;
  return Lowered{constant->value == 0 ? *value : ir::constant(-constant->value, e.range, digits)};
}

std::optional<Lowered> Flattener::binary(State& state, const Binary& node, SourceRange range) {
  const auto left = lower(state, *node.left);
  if (!left) return std::nullopt;
  const auto right = lower(state, *node.right);
  if (!right) return std::nullopt;
  if (isText(*left) != isText(*right) || (isText(*left) && node.op != BinaryOperator::Add)) {
    fail<diag::KindMismatchRun>(isText(*left) ? node.left->range : node.right->range, "a text", "a number");
    return std::nullopt;
  }
  if (isText(*left)) {
    if (!assumes("text-join", range)) return std::nullopt;
    const auto* a = std::get_if<std::string>(&left->fixed);
    const auto* b = std::get_if<std::string>(&right->fixed);
    if (a == nullptr || b == nullptr)
      return Lowered{
          nullptr,
          unknownAt(range, unknownText(*unknownIn(a == nullptr ? left->fixed : right->fixed)), true)};
    if (a->size() + b->size() <= context_.limits.textLength) return Lowered{nullptr, *a + *b};
    fail<diag::TextOverflow>(range, context_.limits.textLength);
    return std::nullopt;
  }
  for (const Lowered* side : {&*left, &*right}) {
    if (isOpaque(*side))
      return Lowered{nullptr, unknownAt(range, unknownText(*unknownIn(side->fixed)), false)};
  }
  const auto a = number(*left, node.left->range);
  const auto b = a ? number(*right, node.right->range) : std::nullopt;
  if (!b) return std::nullopt;
  ir::BinaryOp op = ir::BinaryOp::Add;
  switch (node.op) {
  case BinaryOperator::Add: break;
  case BinaryOperator::Subtract: op = ir::BinaryOp::Subtract; break;
  case BinaryOperator::Multiply: op = ir::BinaryOp::Multiply; break;
  case BinaryOperator::Divide: op = ir::BinaryOp::Divide; break;
  }
  if (op == ir::BinaryOp::Divide) {
    const double* divisor = ir::constantValue(*b);
    if (divisor == nullptr && mayFail(state, range)) return std::nullopt;
    if (divisor != nullptr && *divisor == 0) {
      if (!mayFail(state, range)) fail<diag::DivisionByZero>(range);
      return std::nullopt;
    }
  }
  return Lowered{ir::binary(op, *a, *b, range)};
}

std::optional<Lowered> Flattener::function(State& state, const FunctionCall& call, SourceRange range) {
  const std::string name = foldCase(call.name.text);
  const stdlib::FunctionSpec* spec = context_.keywords.function(name);
  const bool givesText = spec != nullptr ? spec->result == 't' : call.name.isText();
  std::vector<Lowered> arguments;
  bool opaque = false;
  for (const ExpressionPtr& argument : call.arguments) {
    auto value = lower(state, *argument);
    if (!value) return std::nullopt;
    opaque = opaque || isOpaque(*value);
    arguments.push_back(std::move(*value));
  }
  if (spec != nullptr && !spec->types.empty()) {
    if (spec->types.size() != arguments.size()) {
      fail<diag::CannotTranslate>(range, "the function takes another number of values");
      return std::nullopt;
    }
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const bool wantsText = spec->types[i] == 't';
      if (isText(arguments[i]) == wantsText) continue;
      fail<diag::KindMismatchRun>(call.arguments[i]->range, wantsText ? "a number" : "a text",
                                  wantsText ? "a text" : "a number");
      return std::nullopt;
    }
  }
  if (isAngleFunction(name) && !state.angles) {
    const bool degrees = context_.assumptions.contains("angle-degrees");
    if (degrees == context_.assumptions.contains("angle-radians")) {
      fail<diag::AngleUnitOpen>(call.name.range, call.name.text);
      return std::nullopt;
    }
    state.angles = degrees ? ir::AngleUnit::Degrees : ir::AngleUnit::Radians;
  }
  const bool plain = name == "ABS" || name == "INT" || name == "SQRT";
  if (opaque || arguments.empty() || isText(arguments[0]) || (!plain && !isAngleFunction(name)))
    return Lowered{nullptr, unknownAt(range, call.name.text, givesText)};
  if (isAngleFunction(name)) {
    const auto result = angleFunction(state, name, arguments, range);
    return result ? std::optional(Lowered{*result}) : std::nullopt;
  }
  const auto operand = number(arguments[0], range);
  if (!operand || (name == "SQRT" && mayFail(state, range))) return std::nullopt;
  const ir::UnaryOp op = name == "ABS"   ? ir::UnaryOp::Absolute
                         : name == "INT" ? ir::UnaryOp::Truncate
                                         : ir::UnaryOp::SquareRoot;
  return Lowered{ir::unary(op, *operand, range)};
}

std::optional<ir::ExpressionPtr> Flattener::angleFunction(const State& state, const std::string& name,
                                                          const std::vector<Lowered>& arguments,
                                                          SourceRange range) {
  if (name != "SIN" && name != "COS" && mayFail(state, range)) return std::nullopt;
  const bool radians = state.angles == ir::AngleUnit::Radians;
  auto operand = number(arguments[0], range);
  if (!operand) return std::nullopt;
  const auto scaled = [&](const ir::ExpressionPtr& value, double factor) {
    return radians ? ir::binary(ir::BinaryOp::Multiply, value, ir::constant(factor, range), range) : value;
  };
  constexpr double kDegrees = 180 / std::numbers::pi;
  if (name == "ANGLE_LINE") {
    const auto second = arguments.size() == 2 ? number(arguments[1], range) : std::nullopt;
    if (!second) {
      fail<diag::CannotTranslate>(range, "the function takes another number of values");
      return std::nullopt;
    }
    return scaled(ir::binary(ir::BinaryOp::Direction, *operand, *second, range), 1 / kDegrees);
  }
  if (name == "SIN" || name == "COS" || name == "TAN") {
    const ir::UnaryOp op = name == "SIN"   ? ir::UnaryOp::Sine
                           : name == "COS" ? ir::UnaryOp::Cosine
                                           : ir::UnaryOp::Tangent;
    return ir::unary(op, scaled(*operand, kDegrees), range);
  }
  const ir::UnaryOp op = name == "ASIN"   ? ir::UnaryOp::ArcSine
                         : name == "ACOS" ? ir::UnaryOp::ArcCosine
                                          : ir::UnaryOp::ArcTangent;
  return scaled(ir::unary(op, *operand, range), 1 / kDegrees);
}

// ---- variables ------------------------------------------------------------------------------------------

// A local of the running macro, a field that was assigned before the dialog, or the folded name itself.
std::string Flattener::fixedKey(const State& state, const std::string& folded) const {
  const Frame& frame = state.frames.back();
  if (frame.locals.contains(folded)) return fmt::format("#{}:{}", frame.instance, folded);
  return state.shadowed.contains(folded) ? "~" + folded : folded;
}

ir::VariableId Flattener::freshLocal(const std::string& key, const std::string& name) {
  const auto found = variables_.find(key);
  if (found != variables_.end()) return found->second;
  std::string text = name;
  for (int number = 2; !names_.insert(foldCase(text)).second; ++number)
    text = fmt::format("{}_{}", name, number);
  ir::Variable made;
  made.name = text;
  made.role = ir::Role::Local;
  return variables_.emplace(key, cycle_.add(std::move(made))).first->second;
}

ir::VariableId Flattener::variableOf(const std::string& key, const Name& name) {
  if (const auto field = fields_.find(key); field != fields_.end()) return field->second;
  const bool isNew = !variables_.contains(key);
  const ir::VariableId id = freshLocal(key, name.text);
  if (isNew) cycle_.variables[id].range = name.range;
  return id;
}

std::optional<Lowered> Flattener::read(State& state, const VariableRef& ref) {
  const std::string name = foldCase(ref.name.text);
  const bool text = ref.name.isText();
  if (name.size() > kMaxName + (text ? 1 : 0) && !assumes("long-name", ref.name.range)) return std::nullopt;
  if (ref.index) {
    if (lenient_) return Lowered{nullptr, unknownAt(ref.name.range, ref.name.text, text)};
    if (assumes(ref.bracket == '[' ? "array-square" : "array-round", ref.name.range))
      fail<diag::CannotTranslate>(ref.name.range, "an element of an array is read");
    return std::nullopt;
  }
  const std::string key = fixedKey(state, name);
  if (const auto fixed = state.fixed.find(key); fixed != state.fixed.end())
    return Lowered{nullptr, fixed->second};
  if (!state.frames.back().locals.contains(name) && !fields_.contains(name) &&
      name != "CALLBACK_RETURNCODE" &&
      (name.starts_with("CALLBACK_") || context_.keywords.isSystemVariable(name) ||
       context_.keywords.isConstant(name))) {
    return Lowered{nullptr, name.starts_with("NEXT_") ? unknownAt(ref.name.range, name, text)
                                                      : opaqueValue(Symbol::named(name), {}, name, text)};
  }
  if (!text && !lenient_) return Lowered{ir::variable(variableOf(key, ref.name), ref.name.range)};
  if (lenient_) return Lowered{nullptr, unknownAt(ref.name.range, ref.name.text, text)};
  if (context_.assumptions.contains("unset-zero")) return Lowered{nullptr, std::string()};
  fail<diag::ReadBeforeSet>(ref.name.range, ref.name.text);
  return std::nullopt;
}

bool Flattener::write(State& state, const VariableRef& ref, const Lowered& value, SourceRange range) {
  const std::string name = foldCase(ref.name.text);
  const bool text = isText(value);
  if (text != ref.name.isText()) {
    fail<diag::KindMismatchRun>(ref.name.range, text ? "a text" : "a number", text ? "a number" : "a text");
    return false;
  }
  if (name.size() > kMaxName + (text ? 1 : 0) && !assumes("long-name", ref.name.range)) return false;
  if (ref.index) {
    if (assumes(ref.bracket == '[' ? "array-square" : "array-round", ref.name.range))
      fail<diag::CannotTranslate>(ref.name.range, "an element of an array is assigned");
    return false;
  }
  const bool local = state.frames.back().locals.contains(name);
  const bool field = !local && fields_.contains(name);
  const bool code = !local && name == "CALLBACK_RETURNCODE";
  if (!local && !field && !code &&
      (name.starts_with("CALLBACK_") || context_.keywords.isSystemVariable(name) ||
       context_.keywords.isConstant(name))) {
    fail<diag::SystemNameWritten>(ref.name.range, ref.name.text);
    return false;
  }
  const bool beforeDialog = purpose_ == Purpose::Checks && state.dialogs.empty();
  if (field && beforeDialog) state.shadowed.insert(name);
  if (field && !beforeDialog && purpose_ == Purpose::Checks) state.changed.insert(name);
  const std::string key = fixedKey(state, name);
  const bool known = !value.number && std::holds_alternative<double>(value.fixed);
  if (!value.number && !known && !code && !(field && !beforeDialog)) {
    state.fixed[key] = value.fixed;
    return true;
  }
  const auto given = number(value, range);
  if (!given) return false;
  state.fixed.erase(key);
  emit(range, FlatAssign{variableOf(key, ref.name), *given});
  return true;
}

// ---- conditions -----------------------------------------------------------------------------------------

std::optional<ir::ConditionPtr> Flattener::condition(State& state, const Condition& c) {
  if (!c.connectives.empty() && !assumes("and-or", c.range)) return std::nullopt;
  ir::ConditionPtr any;
  ir::ConditionPtr all;
  for (std::size_t i = 0; i < c.comparisons.size(); ++i) {
    const auto holds = comparison(state, c.comparisons[i]);
    if (!holds) return std::nullopt;
    if (i > 0 && c.connectives[i - 1] == Connective::Or) {
      any = any ? ir::join(ir::Connective::Or, any, all, c.range) : all;
      all = nullptr;
    }
    all = all ? ir::join(ir::Connective::And, all, *holds, c.range) : *holds;
  }
  return any ? ir::join(ir::Connective::Or, any, all, c.range) : all;
}

std::optional<ir::ConditionPtr> Flattener::comparison(State& state, const Comparison& c) {
  if (!c.nots.empty() && !assumes("not", c.nots.front())) return std::nullopt;
  if (!c.brackets.empty() && !assumes("condition-brackets", c.brackets.front())) return std::nullopt;
  if (!c.left || !c.right) {
    fail<diag::CannotTranslate>(c.range, "the condition is broken");
    return std::nullopt;
  }
  const auto left = lower(state, *c.left);
  if (!left) return std::nullopt;
  const auto right = lower(state, *c.right);
  if (!right) return std::nullopt;
  if (isText(*left) != isText(*right)) {
    fail<diag::KindMismatchRun>(c.range, "a text", "a number");
    return std::nullopt;
  }
  const bool inverted = c.nots.size() % 2 == 1;
  if (isText(*left)) {
    if (c.relation != Relation::Equal && c.relation != Relation::NotEqual) {
      fail<diag::CannotTranslate>(c.range, "which of two texts is the greater one is not documented");
      return std::nullopt;
    }
    const auto* a = std::get_if<std::string>(&left->fixed);
    const auto* b = std::get_if<std::string>(&right->fixed);
    if (a == nullptr || b == nullptr) {
      fail<diag::CamValue>(c.range, unknownText(*unknownIn(a == nullptr ? left->fixed : right->fixed)));
      return std::nullopt;
    }
    if (*a != *b && foldCase(*a) == foldCase(*b) && !assumes("text-comparison", c.range)) return std::nullopt;
    return ir::truth(((*a == *b) == (c.relation == Relation::Equal)) != inverted, c.range);
  }
  const auto a = number(*left, c.left->range);
  const auto b = a ? number(*right, c.right->range) : std::nullopt;
  if (!b) return std::nullopt;
  const double* first = ir::constantValue(*a);
  const double* second = ir::constantValue(*b);
  if (first != nullptr && second != nullptr)
    return ir::truth(holds(*first, c.relation, *second) != inverted, c.range);
  const ir::Relation relation = relationOf(c.relation);
  return ir::compare(inverted ? ir::opposite(relation) : relation, *a, *b, c.range);
}

} // namespace dotek::frontend::gibbs
