// Defaults against the checks of their own cycle, as far as the text says both.
#include "frontend/cycle/Checker.h"
#include "frontend/cycle/Link.h"
#include "ir/Match.h"
#include "support/messages/Cycle.h"

#include <cmath>
#include <optional>

namespace dotek::frontend::cycle {
namespace {

constexpr double kSame = 1e-9; // mm
constexpr double kInch = 25.4; // mm

using Value = std::optional<double>; // nullopt: not known from the text; a condition is 0 or 1
using Defaults = std::map<std::string, double, std::less<>>;

class Evaluator {
public:
  explicit Evaluator(const Defaults& defaults) : defaults_(defaults) {}

  Value of(const Expression& expression) const {
    return std::visit(
        ir::Overloaded{
            [](const ir::OneOf<Missing, Member, WorkOffset, Text, Given> auto&) { return Value(); },
            [](const Number& number) {
              const bool inch = number.unit == Unit::Inch || number.unit == Unit::InchPerMinute;
              return Value(inch ? number.value * kInch : number.value);
            },
            [&](const NameUse& use) {
              const auto found = defaults_.find(use.name);
              if (found != defaults_.end()) return Value(found->second);
              if (use.name == "yes" || use.name == "no") return Value(use.name == "yes" ? 1 : 0);
              return Value();
            },
            [&](const Unary& unary) {
              const Value value = of(*unary.operand);
              if (!value) return value;
              return Value(unary.op == UnaryOp::Negate ? -*value : *value == 0 ? 1 : 0);
            },
            [&](const Binary& one) { return binary(one); },
            [&](const Function& one) { return function(one); },
            [&](const Bracketed& bracketed) { return of(*bracketed.inner); }},
        expression.node);
  }

private:
  Value binary(const Binary& both) const {
    const Value a = of(*both.left), b = of(*both.right);
    if (both.op == BinaryOp::And && (a == 0.0 || b == 0.0)) return 0;
    if (both.op == BinaryOp::Or && (a == 1.0 || b == 1.0)) return 1;
    if (!a || !b) return std::nullopt;
    const double off = *a - *b;
    switch (both.op) {
    case BinaryOp::Add: return *a + *b;
    case BinaryOp::Subtract: return off;
    case BinaryOp::Multiply: return *a * *b;
    case BinaryOp::Divide: return *b == 0 ? Value() : Value(*a / *b);
    case BinaryOp::Less: return off < -kSame ? 1 : 0;
    case BinaryOp::LessEqual: return off <= kSame ? 1 : 0;
    case BinaryOp::Greater: return off > kSame ? 1 : 0;
    case BinaryOp::GreaterEqual: return off >= -kSame ? 1 : 0;
    case BinaryOp::Is: return std::abs(off) <= kSame ? 1 : 0;
    case BinaryOp::IsNot: return std::abs(off) > kSame ? 1 : 0;
    case BinaryOp::And: return 1;
    case BinaryOp::Or: break;
    }
    return 0;
  }

  Value function(const Function& function) const {
    const std::string& name = function.name.text;
    if (function.arguments.empty()) return std::nullopt;
    const Value first = of(*function.arguments[0]);
    if (!first) return first;
    if (name == "abs") return std::abs(*first);
    if (name == "square") return *first * *first;
    if (name == "sqrt" && *first >= 0) return std::sqrt(*first);
    if (function.arguments.size() != 2 || (name != "min" && name != "max")) return std::nullopt;
    const Value second = of(*function.arguments[1]);
    if (!second) return second;
    return name == "min" ? std::min(*first, *second) : std::max(*first, *second);
  }

  const Defaults& defaults_;
};

} // namespace

void Checker::defaults() {
  Defaults known;
  for (const Statement* const statement : declarations(file_)) {
    const bool own = statement->range.file == file_.file; // options are checked in their own file
    if (const auto* require = std::get_if<Require>(&statement->node);
        require != nullptr && own && Evaluator(known).of(*require->condition) == 0.0) {
      // Over several it may ask for one of them, whichever the caller gives.
      std::size_t deciding = 0;
      for (const auto& one : known) {
        Defaults others = known;
        others.erase(one.first);
        deciding += Evaluator(others).of(*require->condition) == 0.0 ? 0 : 1;
      }
      if (deciding == 1)
        diagnostics_.report<diag::DefaultsRefused>(require->condition->range,
                                                   text(require->condition->range));
    }
    const auto* parameter = std::get_if<Parameter>(&statement->node);
    if (parameter == nullptr || parameter->value == nullptr) continue;
    const Value value = Evaluator(known).of(*parameter->value);
    if (!value || parameter->type.name == TypeName::Choice) continue;
    for (const Name& name : parameter->names)
      known[name.text] = *value;
    for (const Clause& clause : parameter->clauses) {
      bool outside = clause.kind == Clause::Kind::Require && Evaluator(known).of(*clause.first) == 0.0;
      if (clause.kind == Clause::Kind::Range) {
        const Value least = Evaluator(known).of(*clause.first), largest = Evaluator(known).of(*clause.second);
        // A range that is empty is reported for itself.
        if (least && largest && *least > *largest) continue;
        outside = (least && *value < *least - kSame) || (largest && *value > *largest + kSame);
      }
      if (!outside || !own) continue;
      diagnostics_.report<diag::DefaultOutside>(parameter->value->range, parameter->names.front().text,
                                                text(parameter->value->range), text(clause.range));
      break;
    }
  }
}

} // namespace dotek::frontend::cycle
