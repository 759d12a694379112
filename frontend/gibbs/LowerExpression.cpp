#include "frontend/gibbs/LowerFlatten.h"
#include "stdlib/HostInputs.h"
#include "support/messages/Gibbs.h"

#include <numbers>

namespace dotek::frontend::gibbs {
namespace {

// The host input that the value is, "" for any other.
std::string hostOf(const Value& value) {
  const Symbol* symbol = symbolIn(value);
  const bool host =
      symbol != nullptr && symbol->kind == Symbol::Kind::Host && stdlib::isHostInput(symbol->name);
  return host ? symbol->name : "";
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

bool Flattener::isClosed(const Value& value) const {
  return lenient_ ? numberIn(value) == nullptr : unknownIn(value) != nullptr && hostOf(value).empty();
}

bool Flattener::mayFail(const State& state, SourceRange range) {
  if (state.frames.back().onError == nullptr) return false;
  refuse(range, "ON_ERROR is around a computation that may fail");
  return true;
}

std::optional<ir::ExpressionPtr> Flattener::number(const Value& value, SourceRange range) {
  if (const auto* expression = std::get_if<ir::ExpressionPtr>(&value)) return *expression;
  if (const double* known = std::get_if<double>(&value)) return ir::constant(*known, range);
  if (isTextValue(value)) {
    fault<diag::KindMismatchRun>(range, false, "a text", "a number");
    return std::nullopt;
  }
  if (const std::string host = hostOf(value); !host.empty() && context_.host)
    return ir::variable(context_.host(host), range);
  fault<diag::CamValue>(range, false, unknownText(*unknownIn(value)));
  return std::nullopt;
}

// Only ever refused where it is used: the place tells a computed one apart from others.
Value Flattener::opaque(State&, std::string name, const std::vector<Value>& from, const std::string& reason,
                        bool text, SourceRange range) {
  const bool named = !name.empty() && from.empty();
  return opaqueValue(named ? Symbol::named(std::move(name)) : Symbol::place(range), {}, reason, text);
}

Value Flattener::literal(double value, const std::string& digits, SourceRange range) {
  return ir::constant(value, range, digits);
}

std::optional<Value> Flattener::combine(State& state, const Binary& node, const Value& left,
                                        const Value& right, SourceRange range) {
  if (isClosed(left) || isClosed(right)) return std::nullopt;
  const auto a = number(left, node.left->range);
  const auto b = a ? number(right, node.right->range) : std::nullopt;
  if (!b) return std::nullopt;
  const ir::BinaryOp op = irOperator(node.op);
  if (op == ir::BinaryOp::Divide) {
    const double* divisor = ir::constantValue(*b);
    const bool open = divisor == nullptr || *divisor == 0;
    if (open && mayFail(state, range)) return std::nullopt;
    if (open && divisor != nullptr) return computed(ir::divide(1, 0), range);
  }
  return ir::binary(op, *a, *b, range);
}

std::optional<Value> Flattener::apply(State& state, const NumberFunction& function,
                                      const std::vector<Value>& arguments, SourceRange range) {
  for (const Value& each : arguments)
    if (isClosed(each)) return std::nullopt;
  if (function.mayFail && mayFail(state, range)) return std::nullopt;
  const bool radians =
      function.angle != NumberFunction::Angle::None && state.angles == ir::AngleUnit::Radians;
  const auto scaled = [&](const ir::ExpressionPtr& value, NumberFunction::Angle at, double factor) {
    if (!radians || function.angle != at) return value;
    return ir::binary(ir::BinaryOp::Multiply, value, ir::constant(factor, range), range);
  };
  constexpr double kDegrees = 180 / std::numbers::pi;
  std::vector<ir::ExpressionPtr> operands;
  for (const Value& each : arguments) {
    const auto operand = number(each, range);
    if (!operand) return std::nullopt;
    operands.push_back(scaled(*operand, NumberFunction::Angle::Argument, kDegrees));
  }
  const auto* unary = std::get_if<ir::UnaryOp>(&function.op);
  const auto* constant = std::get_if<ir::Constant>(&operands.front()->node);
  if (unary != nullptr && *unary == ir::UnaryOp::Negate && constant != nullptr) {
    const std::string& digits = constant->digits;
    return constant->value == 0 ? operands.front()
                                : ir::constant(-constant->value, range,
                                               digits.empty() || digits.front() == '-' ? "" : "-" + digits);
  }
  return scaled(unary != nullptr ? ir::unary(*unary, operands.front(), range)
                                 : ir::binary(std::get<ir::BinaryOp>(function.op), operands.front(),
                                              operands.back(), range),
                NumberFunction::Angle::Result, 1 / kDegrees);
}

// ---- variables ------------------------------------------------------------------------------------------

// A field that was assigned before the dialog is kept apart from what is typed in.
std::optional<Value> Flattener::fixed(const State& state, const std::string& name) const {
  for (const auto* own : {&state.frames.back().locals, &state.shadowed})
    if (const auto found = own->find(name); found != own->end()) return found->second;
  const auto global = state.globals.find(name);
  return global == state.globals.end() ? std::nullopt : std::optional(global->second);
}

void Flattener::setFixed(State& state, const std::string& name, std::optional<Value> value) {
  for (auto* own : {&state.frames.back().locals, &state.shadowed}) {
    const auto found = own->find(name);
    if (found == own->end()) continue;
    found->second = std::move(value);
    return;
  }
  if (value)
    state.globals[name] = std::move(*value);
  else
    state.globals.erase(name);
}

Flattener::VariableKey Flattener::keyFor(const State& state, const std::string& name) const {
  const Frame& frame = state.frames.back();
  if (frame.locals.contains(name)) return {VariableKey::Kind::Local, name, frame.instance};
  return {state.shadowed.contains(name) ? VariableKey::Kind::Shadow : VariableKey::Kind::Global, name};
}

ir::VariableId Flattener::freshLocal(const VariableKey& key, const std::string& name) {
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

ir::VariableId Flattener::variableOf(const VariableKey& key, const Name& name) {
  const auto field = key.kind == VariableKey::Kind::Global ? fields_.find(key.name) : fields_.end();
  if (field != fields_.end()) return field->second;
  const bool isNew = !variables_.contains(key);
  const ir::VariableId id = freshLocal(key, name.text);
  if (isNew) cycle_.variables[id].range = name.range;
  return id;
}

std::optional<std::string> Flattener::element(State&, const std::string&, const VariableRef& ref,
                                              bool reads) {
  refuse(ref.name.range, reads ? "an element of an array is read" : "an element of an array is assigned");
  return std::nullopt;
}

// Any number may be set when the program runs; whether it is, the walk over the flat code finds out.
std::optional<Value> Flattener::lookUp(State& state, const std::string& key, const VariableRef& ref) {
  if (auto known = fixed(state, key)) return known;
  const bool own = ref.index || state.frames.back().locals.contains(key) || isField(key) ||
                   key == "CALLBACK_RETURNCODE" || !isOfCam(key);
  if (!own || ref.name.isText()) return std::nullopt;
  if (lenient_) return opaque(state, "", {}, ref.name.text, false, ref.name.range);
  return ir::variable(variableOf(keyFor(state, key), ref.name), ref.name.range);
}

bool Flattener::store(State& state, const std::string& key, const VariableRef& ref, Value value,
                      SourceRange range) {
  const bool local = state.frames.back().locals.contains(key);
  const bool field = !local && isField(key);
  const bool code = !local && key == "CALLBACK_RETURNCODE";
  const bool beforeDialog = purpose_ == Purpose::Checks && state.dialogs.empty();
  if (field && beforeDialog) state.shadowed.try_emplace(key);
  if (field && !beforeDialog && purpose_ == Purpose::Checks) state.changed.insert(key);
  const bool isFixed = unknownIn(value) != nullptr || isTextValue(value);
  if (isFixed && !code && !(field && !beforeDialog)) {
    setFixed(state, key, std::move(value));
    return true;
  }
  const auto given = number(value, range);
  if (!given) return false;
  setFixed(state, key, std::nullopt);
  emit(range, FlatAssign{variableOf(keyFor(state, key), ref.name), *given});
  return true;
}

// ---- comparisons ----------------------------------------------------------------------------------------

std::optional<Truth> Flattener::compareNumbers(State&, const Comparison& c, const Value& left,
                                               const Value& right) {
  const auto a = number(left, c.left->range);
  const auto b = a ? number(right, c.right->range) : std::nullopt;
  if (!b) return std::nullopt;
  const double* first = ir::constantValue(*a);
  const double* second = ir::constantValue(*b);
  if (first != nullptr && second != nullptr) return holds(*first, c.relation, *second);
  return ir::compare(relationOf(c.relation), *a, *b, c.range);
}

std::optional<Truth> Flattener::compareTexts(State&, const Comparison& c, const Value& left,
                                             const Value& right) {
  const Unknown* first = unknownIn(left);
  fault<diag::CamValue>(c.range, false, unknownText(first != nullptr ? *first : *unknownIn(right)));
  return std::nullopt;
}

} // namespace dotek::frontend::gibbs
