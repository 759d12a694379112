#include "frontend/gibbs/RunMachine.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <cmath>

namespace dotek::frontend::gibbs {

Value Machine::opaque(State& state, std::string name, const std::vector<Value>& from,
                      const std::string& reason, bool text, SourceRange) {
  constexpr std::size_t kMaxSymbol = 200; // bytes; what has a longer name is its own
  const bool own = name.empty() || name.size() > kMaxSymbol;
  return opaqueValue(own ? Symbol::fresh(++state.fresh) : Symbol::named(std::move(name)), sourcesOf(from),
                     reason, text);
}

std::optional<Value> Machine::combine(State&, const Binary& node, const Value& left, const Value& right,
                                      SourceRange range) {
  const Combined result = gibbs::combine(irOperator(node.op), left, right);
  return result.error == ir::ArithmeticError::None ? result.value : computed({0, result.error}, range);
}

std::optional<Value> Machine::apply(State& state, const NumberFunction& function,
                                    const std::vector<Value>& arguments, SourceRange range) {
  const double* a = std::get_if<double>(&arguments.front());
  const double* b = std::get_if<double>(&arguments.back());
  const bool known = a != nullptr && b != nullptr;
  if (!known && function.op == NumberFunction::Op(ir::UnaryOp::Negate))
    return linear(arguments.front(), -1, 0.0, 0);
  if (!known) return std::nullopt;
  return computed(function.compute(*a, *b, state.angles.value_or(ir::AngleUnit::Degrees)), range);
}

// ---- variables ------------------------------------------------------------------------------------------

std::optional<std::string> Machine::element(State& state, const std::string& key, const VariableRef& ref,
                                            bool) {
  const auto index = evaluateNumber(state, *ref.index);
  if (!index) return std::nullopt;
  const double* number = numberIn(*index);
  const auto size = state.arrays.find(key);
  if (number == nullptr) {
    fault<diag::UnknownValue>(ref.index->range, false, unknownText(*unknownIn(*index)));
    return std::nullopt;
  }
  if (size == state.arrays.end() || *number != std::floor(*number) || *number < 1 ||
      *number > static_cast<double>(size->second)) {
    refuse(ref.index->range, "the array has no such element");
    return std::nullopt;
  }
  return key + "(" + std::to_string(static_cast<std::size_t>(*number)) + ")";
}

std::optional<Value> Machine::lookUp(State& state, const std::string& key, const VariableRef&) {
  const Frame& frame = state.frames.back();
  const auto local = frame.locals.find(key);
  if (local != frame.locals.end()) return local->second;
  const auto global = state.globals.find(key);
  if (global != state.globals.end()) return global->second;
  const auto field = context_.fields.find(key);
  return field == context_.fields.end() ? std::nullopt : std::optional<Value>(field->second);
}

bool Machine::store(State& state, const std::string& key, const VariableRef&, Value value, SourceRange) {
  Frame& frame = state.frames.back();
  if (const auto local = frame.locals.find(key); local != frame.locals.end()) {
    local->second = std::move(value);
    return true;
  }
  if (key == "CALLBACK_RETURNCODE") state.returnCodeSet = place_;
  if (isField(key)) state.fieldSet[key] = place_;
  state.globals[key] = std::move(value);
  return true;
}

// ---- comparisons ----------------------------------------------------------------------------------------

std::optional<Truth> Machine::compareNumbers(State& state, const Comparison& c, const Value& left,
                                             const Value& right) {
  return compare(state, left, c.relation, right, c.range);
}

std::optional<Truth> Machine::compareTexts(State& state, const Comparison& c, const Value& left,
                                           const Value& right) {
  const std::string a = canonical(left);
  const std::string b = canonical(right);
  if (a == b) return c.relation == Relation::Equal;
  const Unknown* first = unknownIn(left);
  const Unknown& unknown = first != nullptr ? *first : *unknownIn(right);
  return ask(state, {std::min(a, b) + " is " + std::max(a, b), c.relation, 0, sourcesOf({left, right}),
                     unknown.reason, c.range});
}

std::optional<bool> Machine::compare(State& state, const Value& left, Relation relation, const Value& right,
                                     SourceRange range) {
  const double* a = std::get_if<double>(&left);
  const double* b = std::get_if<double>(&right);
  if (a != nullptr && b != nullptr) return holds(*a, relation, *b);
  const auto form = linear(left, 1, right, -1);
  const Value difference = form ? *form : opaque(state, "", {left, right}, "an unknown value", false, range);
  const Unknown* unknown = unknownIn(difference);
  if (unknown == nullptr) return holds(std::get<double>(difference), relation, 0);
  return ask(state, questionOf(*unknown, relation, range));
}

// What the path has learnt answers, or the question is open.
std::optional<bool> Machine::ask(const State& state, Question question) {
  const auto learnt = state.learnt.find(question.key);
  const Range known = learnt == state.learnt.end() ? Range() : learnt->second;
  if (const auto answer = known.answer(question.relation, question.bound)) return answer;
  question_ = std::move(question);
  return std::nullopt;
}

std::optional<bool> Machine::isNonZero(State& state, const Value& value, SourceRange range) {
  return compare(state, value, Relation::NotEqual, 0.0, range);
}

} // namespace dotek::frontend::gibbs
