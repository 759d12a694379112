#include "frontend/cycle/Lowering.h"
#include "ir/Fold.h"
#include "ir/Match.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::frontend::cycle {
namespace {

constexpr double kInch = 25.4; // mm

const Expression& within(const Expression& expression) {
  const auto* bracketed = std::get_if<Bracketed>(&expression.node);
  return bracketed == nullptr ? expression : within(*bracketed->inner);
}

ir::ExpressionPtr number(const Number& number, SourceRange range) {
  if (number.unit == Unit::Inch || number.unit == Unit::InchPerMinute)
    return ir::constant(number.value * kInch, range);
  // A text without a point would be read as least increments elsewhere.
  const bool point = number.digits.find('.') != std::string::npos;
  return ir::constant(number.value, range, point ? number.digits : number.digits + ".");
}

bool isLogic(BinaryOp op) {
  return op == BinaryOp::And || op == BinaryOp::Or;
}

std::optional<ir::Relation> relationOf(BinaryOp op) {
  switch (op) {
  case BinaryOp::Less: return ir::Relation::Less;
  case BinaryOp::LessEqual: return ir::Relation::LessEqual;
  case BinaryOp::Greater: return ir::Relation::Greater;
  case BinaryOp::GreaterEqual: return ir::Relation::GreaterEqual;
  case BinaryOp::Is: return ir::Relation::Equal;
  case BinaryOp::IsNot: return ir::Relation::NotEqual;
  default: return std::nullopt;
  }
}

// A function of the language that is one of the IR.
std::optional<ir::UnaryOp> operatorOf(std::string_view name) {
  using enum ir::UnaryOp;
  if (name == "abs") return Absolute;
  if (name == "sqrt") return SquareRoot;
  if (name == "sin") return Sine;
  if (name == "cos") return Cosine;
  if (name == "tan") return Tangent;
  if (name == "asin") return ArcSine;
  if (name == "acos") return ArcCosine;
  if (name == "atan") return ArcTangent;
  if (name == "round") return Round;
  return std::nullopt;
}

} // namespace

const Meaning* Lowering::meaningOf(const Expression& expression) const {
  const Expression& whole = within(expression);
  if (const auto* use = std::get_if<NameUse>(&whole.node)) {
    const auto found = scope_.names.find(use->name);
    return found == scope_.names.end() ? nullptr : &found->second;
  }
  const auto* member = std::get_if<Member>(&whole.node);
  if (member == nullptr) return nullptr;
  const auto object = scope_.names.find(member->object.text);
  if (object == scope_.names.end()) return nullptr;
  const auto part = object->second.members.find(member->member.text);
  return part == object->second.members.end() ? nullptr : &part->second;
}

const std::vector<Name>* Lowering::choicesOf(const Expression& expression) const {
  const Meaning* meaning = meaningOf(expression);
  return meaning == nullptr ? nullptr : meaning->choices;
}

bool Lowering::isFlag(const Expression& expression) const {
  const Expression& whole = within(expression);
  if (const auto* use = std::get_if<NameUse>(&whole.node); use != nullptr && !meaningOf(whole))
    return use->name == "yes" || use->name == "no";
  if (const auto* both = std::get_if<Binary>(&whole.node)) return isLogic(both->op) || relationOf(both->op);
  if (const auto* one = std::get_if<Unary>(&whole.node)) return one->op == UnaryOp::Not;
  if (std::holds_alternative<Given>(whole.node)) return true;
  const Meaning* meaning = meaningOf(whole);
  return meaning != nullptr && meaning->kind == ir::Kind::Flag;
}

ir::Kind Lowering::kindOf(const Expression& expression) const {
  const Expression& whole = within(expression);
  if (isFlag(whole)) return ir::Kind::Flag;
  if (std::holds_alternative<WorkOffset>(whole.node)) return ir::Kind::WorkOffset;
  if (const auto* one = std::get_if<Member>(&whole.node); one != nullptr && toolPart(*one))
    return ir::Kind::Length;
  const Meaning* meaning = meaningOf(whole);
  return meaning == nullptr ? ir::Kind::Number : meaning->kind;
}

ir::ExpressionPtr Lowering::value(const Expression& expression, const std::vector<Name>* choices) {
  const SourceRange range = expression.range;
  const Expression& whole = within(expression);
  return std::visit(ir::Overloaded{[&](const Missing&) { return ir::constant(0, range); },
                                   [&](const Number& one) { return number(one, range); },
                                   [&](const NameUse& use) { return name(whole, use, choices); },
                                   [&](const Member& one) { return member(whole, one); },
                                   [&](const WorkOffset& offset) {
                                     if (offset.extended != 0)
                                       refuse<diag::OffsetExtended>(range, text(range));
                                     return ir::constant(offset.number, range, std::to_string(offset.number));
                                   },
                                   [&](const Text&) { return ir::constant(0, range); },
                                   [&](const Unary& one) {
                                     if (one.op == UnaryOp::Not) return flag(whole);
                                     const ir::ExpressionPtr operand = value(*one.operand);
                                     return ir::simplify(ir::unary(ir::UnaryOp::Negate, operand, range));
                                   },
                                   [&](const Binary& both) { return binary(whole, both); },
                                   [&](const Function& one) { return function(whole, one); },
                                   [&](const Given&) { return flag(whole); },
                                   [&](const Bracketed& one) { return value(*one.inner, choices); }},
                    whole.node);
}

ir::ExpressionPtr Lowering::name(const Expression& expression, const NameUse& use,
                                 const std::vector<Name>* choices) {
  const SourceRange range = expression.range;
  if (choices != nullptr) {
    const auto at =
        std::find_if(choices->begin(), choices->end(), [&](const Name& one) { return one.text == use.name; });
    if (at != choices->end()) return ir::constant(static_cast<double>(at - choices->begin()) + 1, range);
  }
  if (const Meaning* meaning = meaningOf(expression); meaning != nullptr && meaning->value != nullptr) {
    if (const auto* known = std::get_if<ir::VariableUse>(&meaning->value->node))
      return ir::variable(known->variable, range);
    return meaning->value;
  }
  if (use.name == "yes" || use.name == "no") return ir::constant(use.name == "yes" ? 1 : 0, range);
  if (use.name == "ball_radius") return host("tool_radius", ir::Kind::Length);
  if (use.name == "overtravel" || use.name == "retract") return host(use.name, ir::Kind::Length);
  if (use.name == "approach_feed" || use.name == "measuring_feed") return host(use.name, ir::Kind::Feed);
  return ir::constant(0, range); // reported by the checks
}

ir::ExpressionPtr Lowering::member(const Expression& expression, const Member& member) {
  const SourceRange range = expression.range;
  const bool isStart = member.object.text == "start";
  if (isStart || member.object.text == "here") {
    if (member.member.text.empty() || member.member.text[0] < 'x') {
      refuse<diag::RotaryAxis>(range, member.member.text);
      return ir::constant(0, range);
    }
    const auto axis = static_cast<ir::Axis>(member.member.text[0] - 'x');
    return isStart ? start(axis, range) : here(axis, range);
  }
  if (const auto part = toolPart(member)) {
    // As it is now, whatever is set before the value is used.
    const ir::ExpressionPtr tool = scope_.names.at(member.object.text).value;
    const ir::VariableId id =
        local(fmt::format("{}_{}", member.object.text, member.member.text), ir::Kind::Length, range);
    emit(ir::Assign{id, ir::toolValue(partOf(*part), tool, range)}, range);
    return ir::variable(id, range);
  }
  const Meaning* meaning = meaningOf(expression);
  if (meaning == nullptr || meaning->value == nullptr) return ir::constant(0, range);
  if (const auto* known = std::get_if<ir::VariableUse>(&meaning->value->node))
    return ir::variable(known->variable, range);
  return meaning->value;
}

std::optional<ToolPart> Lowering::toolPart(const Member& member) const {
  const auto object = scope_.names.find(member.object.text);
  if (object == scope_.names.end() || object->second.kind != ir::Kind::ToolOffset ||
      object->second.value == nullptr)
    return std::nullopt;
  return toolPartOf(member.member.text);
}

ir::ExpressionPtr Lowering::binary(const Expression& expression, const Binary& both) {
  const SourceRange range = expression.range;
  ir::BinaryOp op = ir::BinaryOp::Add;
  switch (both.op) {
  case BinaryOp::Add: break;
  case BinaryOp::Subtract: op = ir::BinaryOp::Subtract; break;
  case BinaryOp::Multiply: op = ir::BinaryOp::Multiply; break;
  case BinaryOp::Divide: op = ir::BinaryOp::Divide; break;
  case BinaryOp::Less:
  case BinaryOp::LessEqual:
  case BinaryOp::Greater:
  case BinaryOp::GreaterEqual:
  case BinaryOp::Is:
  case BinaryOp::IsNot:
  case BinaryOp::And:
  case BinaryOp::Or: return flag(expression);
  }
  const ir::ExpressionPtr left = value(*both.left);
  const ir::ExpressionPtr right = value(*both.right);
  return ir::binary(op, left, right, range);
}

// A condition as a value: 1 where it holds, 0 where not.
ir::ExpressionPtr Lowering::flag(const Expression& expression) {
  const SourceRange range = expression.range;
  if (const auto known = decided(expression)) return ir::constant(*known ? 1 : 0, range);
  const ir::VariableId id = local("flag", ir::Kind::Flag, range);
  const ir::LabelId no = label("flag_no", range), end = label("flag_end", range);
  branch(expression, false, no);
  emit(ir::Assign{id, ir::constant(1, range)}, range);
  jump(end, range);
  place(no, range);
  emit(ir::Assign{id, ir::constant(0, range)}, range);
  place(end, range);
  return ir::variable(id, range);
}

ir::ExpressionPtr Lowering::kept(const ir::ExpressionPtr& value, std::string_view name, ir::Kind kind,
                                 SourceRange range) {
  if (std::holds_alternative<ir::Constant>(value->node)) return value;
  const ir::VariableId id = local(name, kind, range);
  emit(ir::Assign{id, value}, range);
  return ir::variable(id, range);
}

ir::ExpressionPtr Lowering::least(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b, bool greatest,
                                  SourceRange range) {
  const std::string_view name = greatest ? "greatest" : "least";
  const ir::ExpressionPtr second = kept(b, "other", ir::Kind::Number, range);
  const ir::VariableId id = local(name, ir::Kind::Number, range);
  const ir::LabelId end = label(std::string(name) + "_end", range);
  emit(ir::Assign{id, a}, range);
  emit(ir::Branch{ir::compare(greatest ? ir::Relation::GreaterEqual : ir::Relation::LessEqual,
                              ir::variable(id), second, range),
                  end},
       range);
  emit(ir::Assign{id, second}, range);
  place(end, range);
  return ir::variable(id, range);
}

// The whole number above or below: FIX and FUP of a control go toward zero and away from it.
ir::ExpressionPtr Lowering::towards(const ir::ExpressionPtr& given, bool up, SourceRange range) {
  const ir::ExpressionPtr from = kept(given, "exact", ir::Kind::Number, range);
  const ir::VariableId id = local(up ? "above" : "below", ir::Kind::Number, range);
  const ir::LabelId end = label(up ? "above_end" : "below_end", range);
  emit(ir::Assign{id, ir::unary(ir::UnaryOp::Truncate, from, range)}, range);
  emit(ir::Branch{ir::compare(up ? ir::Relation::GreaterEqual : ir::Relation::LessEqual, ir::variable(id),
                              from, range),
                  end},
       range);
  emit(ir::Assign{id, ir::binary(up ? ir::BinaryOp::Add : ir::BinaryOp::Subtract, ir::variable(id),
                                 ir::constant(1), range)},
       range);
  place(end, range);
  return ir::variable(id, range);
}

ir::ExpressionPtr Lowering::function(const Expression& expression, const Function& function) {
  const SourceRange range = expression.range;
  const std::string& called = function.name.text;
  std::vector<ir::ExpressionPtr> given;
  for (const ExpressionPtr& argument : function.arguments)
    given.push_back(value(*argument));
  if (given.empty()) return ir::constant(0, range);
  if (given.size() == 2) {
    if (called == "atan") return ir::binary(ir::BinaryOp::Direction, given[1], given[0], range);
    return least(given[0], given[1], called == "max", range);
  }
  if (called == "square") {
    const ir::ExpressionPtr side = std::holds_alternative<ir::VariableUse>(given[0]->node)
                                       ? given[0]
                                       : kept(given[0], "side", ir::Kind::Number, range);
    return ir::binary(ir::BinaryOp::Multiply, side, side, range);
  }
  if (called == "down" || called == "up") return towards(given[0], called == "up", range);
  const auto op = operatorOf(called);
  return op ? ir::unary(*op, given[0], range) : given[0];
}

std::optional<bool> Lowering::decided(const Expression& condition) const {
  const Expression& whole = within(condition);
  if (const auto* given = std::get_if<Given>(&whole.node)) {
    const auto found = scope_.names.find(given->name.text);
    return found == scope_.names.end() ? std::nullopt : found->second.given;
  }
  if (const auto* one = std::get_if<Unary>(&whole.node); one != nullptr && one->op == UnaryOp::Not) {
    const auto inner = decided(*one->operand);
    return inner ? std::optional(!*inner) : std::nullopt;
  }
  if (const auto* use = std::get_if<NameUse>(&whole.node)) {
    const Meaning* meaning = meaningOf(whole);
    if (meaning == nullptr && (use->name == "yes" || use->name == "no")) return use->name == "yes";
    const double* known =
        meaning == nullptr || meaning->value == nullptr ? nullptr : ir::constantValue(meaning->value);
    return known == nullptr ? std::nullopt : std::optional(*known != 0);
  }
  const auto* both = std::get_if<Binary>(&whole.node);
  if (both == nullptr || !isLogic(both->op)) return std::nullopt;
  const bool deciding = both->op == BinaryOp::Or;
  const auto left = decided(*both->left), right = decided(*both->right);
  if (left == deciding) return deciding;
  if (left && right) return *right;
  return std::nullopt;
}

bool Lowering::isSimple(const Expression& condition) const {
  return std::visit(
      ir::Overloaded{
          [](const ir::OneOf<Missing, Number, NameUse, WorkOffset, Text> auto&) { return true; },
          [&](const Member& member) { return member.object.text != "here" && !toolPart(member); },
          [](const Given&) { return false; }, [&](const Unary& one) { return isSimple(*one.operand); },
          [&](const Binary& both) {
            // A flag that is compared is computed by statements.
            const bool flags = relationOf(both.op) && (isLogicValue(*both.left) || isLogicValue(*both.right));
            return !flags && isSimple(*both.left) && isSimple(*both.right);
          },
          [&](const Function& function) {
            return operatorOf(function.name.text).has_value() &&
                   std::all_of(function.arguments.begin(), function.arguments.end(),
                               [&](const ExpressionPtr& one) { return isSimple(*one); });
          },
          [&](const Bracketed& one) { return isSimple(*one.inner); }},
      condition.node);
}

bool Lowering::isLogicValue(const Expression& expression) const {
  const Expression& whole = within(expression);
  if (const auto* both = std::get_if<Binary>(&whole.node)) return isLogic(both->op) || relationOf(both->op);
  if (const auto* one = std::get_if<Unary>(&whole.node)) return one->op == UnaryOp::Not;
  return std::holds_alternative<Given>(whole.node);
}

ir::ConditionPtr Lowering::condition(const Expression& expression) {
  const Expression& whole = within(expression);
  const SourceRange range = whole.range;
  if (const auto* given = std::get_if<Given>(&whole.node)) {
    if (const auto touch = scope_.names.find(foundName(given->name.text)); touch != scope_.names.end())
      return ir::compare(ir::Relation::NotEqual, touch->second.value, ir::constant(0), range);
    const auto found = scope_.names.find(given->name.text);
    if (found == scope_.names.end() || found->second.given) {
      const bool is = found != scope_.names.end() && *found->second.given;
      return ir::truth(is, range);
    }
    return ir::negate(ir::isNull(found->second.value, range));
  }
  if (const auto* one = std::get_if<Unary>(&whole.node); one != nullptr && one->op == UnaryOp::Not)
    return ir::negate(condition(*one->operand));
  if (const auto* both = std::get_if<Binary>(&whole.node)) {
    if (isLogic(both->op)) {
      const ir::ConditionPtr left = condition(*both->left);
      const ir::ConditionPtr right = condition(*both->right);
      return ir::join(both->op == BinaryOp::And ? ir::Connective::And : ir::Connective::Or, left, right,
                      range);
    }
    if (const auto relation = relationOf(both->op)) {
      const std::vector<Name>* choices = choicesOf(*both->left);
      const ir::ExpressionPtr left = value(*both->left);
      const ir::ExpressionPtr right = value(*both->right, choices);
      return ir::compare(*relation, left, right, range);
    }
  }
  return ir::compare(ir::Relation::NotEqual, value(whole), ir::constant(0), range);
}

void Lowering::branch(const Expression& given, bool when, ir::LabelId target) {
  const Expression& whole = within(given);
  const SourceRange range = whole.range;
  if (const auto known = decided(whole)) {
    if (*known == when) jump(target, range);
    return;
  }
  if (const auto* one = std::get_if<Unary>(&whole.node); one != nullptr && one->op == UnaryOp::Not)
    return branch(*one->operand, !when, target);
  const auto* both = std::get_if<Binary>(&whole.node);
  if (both != nullptr && isLogic(both->op) && !isSimple(whole)) {
    // A part that asks whether a value is given guards the parts after it.
    const bool deciding = both->op == BinaryOp::Or; // the left side decides where it is this
    if (deciding == when) {
      branch(*both->left, when, target);
      branch(*both->right, when, target);
      return;
    }
    const ir::LabelId other = label("decided", range);
    branch(*both->left, deciding, other);
    branch(*both->right, when, target);
    place(other, range);
    return;
  }
  const ir::ConditionPtr held = condition(whole);
  emit(ir::Branch{when ? held : ir::negate(held), target}, range);
}

} // namespace dotek::frontend::cycle
