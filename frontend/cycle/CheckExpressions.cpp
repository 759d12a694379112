#include "frontend/cycle/Checker.h"
#include "frontend/cycle/Link.h"
#include "frontend/cycle/Words.h"
#include "ir/Match.h"
#include "support/Decimal.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::cycle {

using Base = Quantity::Base;

namespace {

constexpr std::array<std::string_view, 14> kFunctions = {"abs",   "sqrt", "sin",  "cos",   "tan",
                                                         "asin",  "acos", "atan", "min",   "max",
                                                         "round", "down", "up",   "square"};

// Past the first ones no hint is read, and each costs as much as there are names.
constexpr int kMostHints = 200;

bool comparesOrder(BinaryOp op) {
  return op == BinaryOp::Less || op == BinaryOp::LessEqual || op == BinaryOp::Greater ||
         op == BinaryOp::GreaterEqual;
}

bool sameChoices(const std::vector<Name>* a, const std::vector<Name>* b) {
  return a == b || (a != nullptr && b != nullptr &&
                    std::equal(a->begin(), a->end(), b->begin(), b->end(),
                               [](const Name& one, const Name& other) { return one.text == other.text; }));
}

Quantity plain(Base base) {
  return {base, 1, nullptr};
}

const Expression& inner(const Expression& expression) {
  const auto* bracketed = std::get_if<Bracketed>(&expression.node);
  return bracketed == nullptr ? expression : inner(*bracketed->inner);
}

// `5`, `-5`, `(5)`: a number that only lacks its unit.
bool isBareNumber(const Expression& expression) {
  const Expression& within = inner(expression);
  if (const auto* unary = std::get_if<Unary>(&within.node))
    return unary->op == UnaryOp::Negate && isBareNumber(*unary->operand);
  const auto* number = std::get_if<Number>(&within.node);
  return number != nullptr && number->unit == Unit::None;
}

// The unit after `5` or `-5`; nothing where the number is in brackets.
std::optional<Fix> withUnit(const Expression& number, std::string_view unit) {
  if (std::holds_alternative<Bracketed>(number.node)) return std::nullopt;
  const SourceRange after{number.range.file, number.range.end, number.range.end};
  return Fix{Fix::Applicability::Display, fmt::format("add `{}`", unit), {{after, fmt::format(" {}", unit)}}};
}

// The comparison that a condition ends with, or begins with; nullptr: neither is one.
const Binary* comparisonIn(const Expression& condition) {
  const auto* binary = std::get_if<Binary>(&inner(condition).node);
  if (binary == nullptr) return nullptr;
  if (binary->op != BinaryOp::And && binary->op != BinaryOp::Or)
    return binary->op == BinaryOp::Is || binary->op == BinaryOp::IsNot ? binary : nullptr;
  const Binary* const last = comparisonIn(*binary->right);
  return last != nullptr ? last : comparisonIn(*binary->left);
}

// The number without unit that a product has on one of its sides; nullptr: there is none.
const Expression* bareFactor(const Expression& expression) {
  const auto* product = std::get_if<Binary>(&inner(expression).node);
  if (product == nullptr || product->op != BinaryOp::Multiply) return nullptr;
  for (const Expression* const side : {product->left.get(), product->right.get()})
    if (std::holds_alternative<Number>(side->node) && isBareNumber(*side)) return side;
  return nullptr;
}

} // namespace

// `side is left or right`: what the whole comparison would be; "" where `right` is something else.
std::string Checker::wholeComparison(const Binary& join) const {
  const bool joins = join.op == BinaryOp::And || join.op == BinaryOp::Or;
  const Binary* const asked = joins ? comparisonIn(*join.left) : nullptr;
  const auto* subject = asked == nullptr ? nullptr : std::get_if<NameUse>(&inner(*asked->left).node);
  const auto known = subject == nullptr ? symbols_.end() : symbols_.find(subject->name);
  if (known == symbols_.end()) return "";
  const Expression& other = inner(*join.right);
  const Quantity& of = known->second.quantity;
  const auto* name = std::get_if<NameUse>(&other.node);
  const auto offers = [&] {
    return name != nullptr && of.choices != nullptr &&
           std::any_of(of.choices->begin(), of.choices->end(),
                       [&](const Name& one) { return one.text == name->name; });
  };
  if (!offers() && !(std::holds_alternative<Number>(other.node) && of.isNumeric())) return "";
  const bool no = asked->op == BinaryOp::IsNot;
  const std::string_view is = no ? "is not" : "is";
  return fmt::format("{} {} {} {} {} {} {}", subject->name, is, text(asked->right->range),
                     no || join.op == BinaryOp::And ? "and" : "or", subject->name, is, text(other.range));
}

void Checker::unknownName(SourceRange range, const std::string& name) {
  if (const auto below = below_.find(name); below != below_.end()) {
    diagnostics_
        .report<diag::DeclaredBelow>(range, name, sources_.line(below->second),
                                     inClause_ ? ", or write the check as a `require` line after both" : "")
        .note(below->second, "it is declared here");
    return;
  }
  if (unreadable_.contains(name)) return;
  const std::string near = name == "true"              ? "yes"
                           : name == "false"           ? "no"
                           : nameHints_++ < kMostHints ? nameLike(name, symbols_)
                                                       : "";
  std::string hint = near.empty() ? "" : "; did you mean `" + near + "`?";
  if (name == "pi" && near.empty())
    hint = "; angles have their unit, `180 deg`, and functions take and give them so";
  diagnostics_.report<diag::UnknownValueName>(range, name, hint).fix = writeInstead(range, near);
}

bool Checker::unnamedTouch(const Member& member) {
  constexpr std::array<std::string_view, 5> kMembers = {"at", "at_x", "at_y", "at_z", "error"};
  const std::string& name = member.object.text;
  if (unnamed_.empty() || nameHints_ >= kMostHints) return false;
  ++nameHints_;
  if (unreadable_.contains(name) || below_.contains(name) || !nearestName(name, later_).empty() ||
      std::find(kMembers.begin(), kMembers.end(), member.member.text) == kMembers.end())
    return false;
  const SourceRange* touch = nullptr;
  for (const SourceRange& one : unnamed_)
    if (one.begin < member.object.range.begin) touch = &one;
  if (touch == nullptr) return false;
  diagnostics_
      .report<diag::UnknownValueName>(
          member.object.range, name,
          fmt::format("; name the touch of line {}: `{} -> {}`", sources_.line(*touch), text(*touch), name))
      .note(*touch, "this touch gives no name");
  return true;
}

void Checker::mismatch(const Expression& left, const Quantity& a, const Expression& right, const Quantity& b,
                       SourceRange where, std::string_view doing) {
  const auto bare = [&](const Expression& number, const Quantity& other) {
    if (!isBareNumber(number) || unitFor(other).empty()) return false;
    diagnostics_
        .report<diag::UnitMissing>(number.range, text(number.range), quantityText(other),
                                   fmt::format("{} {}", text(number.range), unitFor(other)))
        .fix = withUnit(number, unitFor(other));
    return true;
  };
  if (bare(right, a) || bare(left, b)) return;
  // `rough is 1`.
  const auto* number = std::get_if<Number>(&inner(right).node);
  std::string hint;
  if (a.base == Base::Flag && number != nullptr && (number->value == 0 || number->value == 1))
    hint = fmt::format("; a condition is asked for by itself: write `{}{}`", number->value == 0 ? "not " : "",
                       text(left.range));
  diagnostics_.report<diag::KindsMixed>(where, doing, quantityText(a), text(left.range), quantityText(b),
                                        text(right.range), hint);
}

void Checker::want(const Expression& expression, Quantity wanted, std::string_view what, const Known& known) {
  if (wanted.base == Base::Choice) {
    choice(expression, wanted, known);
    return;
  }
  const Quantity found = quantity(expression, known);
  if (found.fits(wanted)) return;
  const std::string written = text(expression.range);
  const auto* number = std::get_if<Number>(&inner(expression).node);
  const double value = number == nullptr ? 0 : number->value;
  if (isBareNumber(expression) && !unitFor(wanted).empty()) {
    std::string right = fmt::format("{} {}", written, unitFor(wanted));
    std::optional<Fix> repair = withUnit(expression, unitFor(wanted));
    // A control counts a pause in milliseconds.
    constexpr double kLongPause = 50; // s
    if (wanted.base == Base::Time && value >= kLongPause) {
      right = fmt::format("{} s` where these are milliseconds, else `{}", numberText(value / 1000), right);
      repair.reset(); // which of them is meant is not known
    }
    diagnostics_.report<diag::UnitMissing>(expression.range, written, quantityText(wanted), right).fix =
        std::move(repair);
    return;
  }
  std::string kind = quantityText(found);
  if (wanted.base == Base::WorkOffset && isBareNumber(expression))
    kind += value >= 54 && value <= 59 ? fmt::format("; write `G{}`", written) : "; those are `G54` to `G59`";
  // `90 * i`: the unit goes to the number.
  if (const Expression* const factor = bareFactor(expression);
      found.base == Base::Number && factor != nullptr && !unitFor(wanted).empty()) {
    std::string right = written;
    right.insert(text({expression.range.file, expression.range.begin, factor->range.end}).size(),
                 fmt::format(" {}", unitFor(wanted)));
    kind += fmt::format("; write `{}`", right);
  }
  diagnostics_.report<diag::WrongValue>(expression.range, what, quantityText(wanted), written, kind);
}

void Checker::wantFlag(const Expression& expression, std::string_view where, const Known& known) {
  const Quantity found = quantity(expression, known);
  if (found.fits(plain(Base::Flag))) return;
  diagnostics_.report<diag::ConditionWanted>(expression.range, where, text(expression.range),
                                             quantityText(found));
}

void Checker::wantAxis(const Expression& expression, Axis axis, std::string_view what, const Known& known) {
  want(expression, plain(axis <= Axis::Z ? Base::Length : Base::Angle), what, known);
}

Quantity Checker::choice(const Expression& expression, const Quantity& of, const Known& known) {
  const Expression& within = inner(expression);
  const auto* use = std::get_if<NameUse>(&within.node);
  if (use != nullptr && of.choices != nullptr) {
    const auto at = std::find_if(of.choices->begin(), of.choices->end(),
                                 [&](const Name& one) { return one.text == use->name; });
    if (at != of.choices->end()) return of;
  }
  if (const auto named = use == nullptr ? symbols_.end() : symbols_.find(use->name);
      named != symbols_.end() && named->second.quantity.base == Base::Choice &&
      sameChoices(named->second.quantity.choices, of.choices)) {
    name(within, *use, known);
    return of;
  }
  std::string names;
  if (of.choices != nullptr)
    for (const Name& one : *of.choices)
      names += (names.empty() ? "`" : ", `") + one.text + "`";
  diagnostics_.report<diag::UnknownChoice>(expression.range, text(expression.range), names);
  return of;
}

void Checker::addGiven(const Expression& condition, bool truth, Known& known) const {
  std::visit(
      ir::Overloaded{[&](const Missing&) {
                       // A line that could not be read may ask for any name in it.
                       for (std::string& word : wordsOf(sources_.text(condition.range)))
                         known.given.insert(std::move(word));
                     },
                     [&](const Given& given) {
                       if (truth) known.given.insert(given.name.text);
                     },
                     [&](const Bracketed& bracketed) { addGiven(*bracketed.inner, truth, known); },
                     [&](const Unary& unary) {
                       if (unary.op == UnaryOp::Not) addGiven(*unary.operand, !truth, known);
                     },
                     [&](const Binary& binary) {
                       const bool both =
                           (binary.op == BinaryOp::And && truth) || (binary.op == BinaryOp::Or && !truth);
                       if (!both) return;
                       addGiven(*binary.left, truth, known);
                       addGiven(*binary.right, truth, known);
                     },
                     [](const ir::OneOf<Number, NameUse, Member, WorkOffset, Text, Function> auto&) {}},
      condition.node);
}

Quantity Checker::name(const Expression& expression, const NameUse& use, const Known& known) {
  if (use.name == "start" || use.name == "here") {
    diagnostics_.report<diag::PlaceWithoutAxis>(expression.range, use.name);
    return {};
  }
  const auto found = symbols_.find(use.name);
  if (found == symbols_.end()) {
    if (later_.contains(use.name))
      diagnostics_.report<diag::UsedBeforeSet>(expression.range, use.name, "value");
    else
      unknownName(expression.range, use.name);
    symbols_[use.name].quantity = {}; // once
    symbols_[use.name].read = true;
    return {};
  }
  Symbol& symbol = found->second;
  symbol.read = true;
  switch (symbol.role) {
  case Symbol::Role::Host: return symbol.quantity;
  case Symbol::Role::Parameter:
    if (symbol.parameter->optional && symbol.parameter->value == nullptr && !known.given.contains(use.name))
      diagnostics_.report<diag::OptionalUnchecked>(expression.range, use.name);
    return symbol.quantity;
  case Symbol::Role::Touch:
  case Symbol::Role::Call: {
    const std::string member =
        symbol.role == Symbol::Role::Touch ? symbol.direction ? "at_x" : "at" : "RESULT";
    Diagnostic& wanted = diagnostics_.report<diag::MemberWanted>(
        expression.range, use.name, symbol.role == Symbol::Role::Touch ? "touch" : "called cycle", member);
    if (member == "at") wanted.fix = writeInstead(expression.range, use.name + ".at");
    return {};
  }
  case Symbol::Role::Result:
  case Symbol::Role::Local:
  case Symbol::Role::Counter: break;
  }
  if (symbol.range.hasPlace() && !known.set.contains(use.name) && !known.ended)
    diagnostics_.report<diag::UsedBeforeSet>(expression.range, use.name,
                                             symbol.role == Symbol::Role::Result ? "result" : "value");
  return symbol.quantity;
}

Quantity Checker::member(const Expression& expression, const Member& member, const Known& known) {
  const std::string& object = member.object.text;
  const std::string& part = member.member.text;
  const bool place = object == "start" || object == "here";
  if (place) {
    if (part.size() == 1 && std::string_view("xyzabc").find(part) != std::string_view::npos)
      return plain(part[0] >= 'x' ? Base::Length : Base::Angle);
    diagnostics_.report<diag::PlaceWithoutAxis>(expression.range, object);
    return {};
  }
  const auto found = symbols_.find(object);
  if (found == symbols_.end()) {
    const auto later = later_.find(object);
    if (later == later_.end() || later->second == Symbol::Role::Local) {
      if (later != later_.end() || !unnamedTouch(member)) unknownName(member.object.range, object);
      if (later == later_.end() && !below_.contains(object)) symbols_[object].read = true; // once
    } else {
      diagnostics_.report<diag::ReadBeforeTouch>(expression.range, text(expression.range), object,
                                                 later->second == Symbol::Role::Touch ? "touch" : "call");
    }
    return {};
  }
  Symbol& symbol = found->second;
  symbol.read = true;
  if (symbol.quantity.base == Base::ToolOffset) {
    name({member.object.range, NameUse{object}}, {object}, known);
    if (toolPartOf(part)) return plain(Base::Length);
    diagnostics_.report<diag::UnknownMember>(
        member.member.range, object, part,
        fmt::format("`{0}.length`, `{0}.length_wear`, `{0}.radius`, `{0}.radius_wear`", object));
    return {};
  }
  if (symbol.role != Symbol::Role::Touch && symbol.role != Symbol::Role::Call) {
    if (symbol.range.hasPlace() || symbol.role == Symbol::Role::Host)
      diagnostics_.report<diag::NoMembers>(expression.range, object);
    return {};
  }
  if (!known.has(object) && !known.ended) {
    if (mayMiss_.contains(object))
      diagnostics_.report<diag::ReadOfMissed>(expression.range, text(expression.range), object);
    else
      diagnostics_.report<diag::ReadBeforeTouch>(expression.range, text(expression.range), object,
                                                 symbol.role == Symbol::Role::Touch ? "touch" : "call");
  }
  if (symbol.role == Symbol::Role::Touch) {
    const std::vector<std::string> members = symbol.direction
                                                 ? std::vector<std::string>{"at_x", "at_y", "at_z", "error"}
                                                 : std::vector<std::string>{"at", "error"};
    if (std::find(members.begin(), members.end(), part) != members.end()) return plain(Base::Length);
    std::string names;
    for (const std::string& one : members)
      names += (names.empty() ? "`" : ", `") + object + "." + one + "`";
    diagnostics_.report<diag::UnknownMember>(member.member.range, object, part, names).fix =
        writeInstead(member.member.range, nearestName(part, members));
    return {};
  }
  if (symbol.cycle == nullptr) return {};
  std::string names;
  NearestName near(part);
  for (const Statement* statement : declarations(*symbol.cycle)) {
    const auto* result = std::get_if<Result>(&statement->node);
    if (result == nullptr) continue;
    for (const Name& one : result->names) {
      if (one.text == part) return quantityOf(result->type);
      names += (names.empty() ? "`" : ", `") + object + "." + one.text + "`";
      if (!near.full()) near.offer(one.text);
    }
  }
  diagnostics_
      .report<diag::UnknownMember>(member.member.range, object, part,
                                   names.empty() ? "nothing: it has no results" : names)
      .fix = writeInstead(member.member.range, near.result());
  return {};
}

Quantity Checker::function(const Expression& expression, const Function& function, const Known& known) {
  const std::string& called = function.name.text;
  std::vector<Quantity> given;
  for (const ExpressionPtr& argument : function.arguments)
    given.push_back(quantity(*argument, known));
  if (std::find(kFunctions.begin(), kFunctions.end(), called) == kFunctions.end()) {
    const std::string near = nearestName(called, kFunctions);
    diagnostics_
        .report<diag::UnknownFunction>(function.name.range, called,
                                       near.empty() ? "" : " (did you mean `" + near + "`?)")
        .fix = writeInstead(function.name.range, near);
    return {};
  }
  const bool two = called == "min" || called == "max";
  const bool direction = called == "atan" && given.size() == 2;
  const std::size_t wanted = two || direction ? 2 : 1;
  if (given.size() != wanted) {
    diagnostics_.report<diag::FunctionArguments>(expression.range, called,
                                                 called == "atan" ? "a ratio, or two lengths `atan(y, x)`"
                                                 : two            ? "two values"
                                                                  : "one value",
                                                 given.size());
    return {};
  }
  if (two || direction) {
    if (!given[0].fits(given[1]) || !given[0].isNumeric()) {
      mismatch(*function.arguments[0], given[0], *function.arguments[1], given[1], expression.range,
               "compares");
      return {};
    }
    if (direction) return plain(Base::Angle);
    return given[0].base == Base::Zero ? given[1] : given[0];
  }
  const Expression& argument = *function.arguments[0];
  const auto takes = [&](Base base) {
    want(argument, plain(base), fmt::format("`{}`", called), known);
    return given[0].fits(plain(base));
  };
  if (called == "abs") {
    if (!given[0].isNumeric()) takes(Base::Number);
    return given[0];
  }
  if (called == "square") {
    if (given[0].base == Base::Length) return {Base::Length, given[0].power * 2, nullptr};
    return takes(Base::Number) ? plain(Base::Number) : Quantity{};
  }
  if (called == "sqrt") {
    if (given[0].base == Base::Length && given[0].power % 2 == 0)
      return {Base::Length, given[0].power / 2, nullptr};
    return takes(Base::Number) ? plain(Base::Number) : Quantity{};
  }
  if (called == "sin" || called == "cos" || called == "tan") {
    return takes(Base::Angle) ? plain(Base::Number) : Quantity{};
  }
  if (!takes(Base::Number)) return {};
  return plain(called == "asin" || called == "acos" || called == "atan" ? Base::Angle : Base::Number);
}

Quantity Checker::binary(const Expression& expression, const Binary& binary, const Known& known) {
  const Expression& left = *binary.left;
  const Expression& right = *binary.right;
  if (binary.op == BinaryOp::And || binary.op == BinaryOp::Or) {
    const std::string_view word = binary.op == BinaryOp::And ? "`and`" : "`or`";
    wantFlag(left, word, known);
    Known within = known;
    addGiven(left, binary.op == BinaryOp::And, within);
    const std::string whole = wholeComparison(binary);
    const auto* before = std::get_if<Binary>(&inner(left).node);
    const bool said = before != nullptr && !wholeComparison(*before).empty(); // `is left or right or front`
    if (whole.empty())
      wantFlag(right, word, within);
    else if (!said)
      diagnostics_.report<diag::HalfComparison>(right.range, binary.op == BinaryOp::And ? "and" : "or",
                                                whole);
    return plain(Base::Flag);
  }
  const Quantity a = quantity(left, known);
  const bool same = binary.op == BinaryOp::Is || binary.op == BinaryOp::IsNot;
  if (same && a.base == Base::Choice) {
    choice(right, a, known);
    return plain(Base::Flag);
  }
  const Quantity b = quantity(right, known);
  if (comparesOrder(binary.op) || same) {
    if (!a.fits(b) || (!same && (!a.isNumeric() || !b.isNumeric())))
      mismatch(left, a, right, b, expression.range, "compares");
    return plain(Base::Flag);
  }
  const bool sum = binary.op == BinaryOp::Add || binary.op == BinaryOp::Subtract;
  if (!a.isNumeric() || !b.isNumeric() || (sum && !a.fits(b))) {
    mismatch(left, a, right, b, expression.range, sum ? "adds" : "multiplies");
    return {};
  }
  if (a.base == Base::Unknown || b.base == Base::Unknown) return {};
  if (sum) return a.base == Base::Zero ? b : a;
  const bool divides = binary.op == BinaryOp::Divide;
  if (a.base == Base::Zero) return a;
  if (b.base == Base::Zero) {
    if (divides) diagnostics_.report<diag::DividesByZero>(expression.range, text(expression.range));
    return b;
  }
  if (b.base == Base::Number || b.base == Base::ToolOffset) return a;
  if (a.base == Base::Number && !divides) return b;
  if (a.base == Base::Length && b.base == Base::Length) {
    const int power = divides ? a.power - b.power : a.power + b.power;
    return power == 0 ? plain(Base::Number) : Quantity{Base::Length, power, nullptr};
  }
  if (divides && a.base == b.base) return plain(Base::Number);
  mismatch(left, a, right, b, expression.range, divides ? "divides" : "multiplies");
  return {};
}

Quantity Checker::quantity(const Expression& expression, const Known& known) {
  return std::visit(
      ir::Overloaded{
          [](const Missing&) { return Quantity{}; },
          [](const Number& number) {
            switch (number.unit) {
            case Unit::None: return plain(number.value == 0 ? Base::Zero : Base::Number);
            case Unit::Millimetre:
            case Unit::Inch: return plain(Base::Length);
            case Unit::Degree: return plain(Base::Angle);
            case Unit::MillimetrePerMinute:
            case Unit::InchPerMinute: return plain(Base::Feed);
            case Unit::Second: break;
            }
            return plain(Base::Time);
          },
          [&](const NameUse& use) { return name(expression, use, known); },
          [&](const Member& one) { return member(expression, one, known); },
          [](const WorkOffset&) { return plain(Base::WorkOffset); },
          [](const Text&) { return plain(Base::Text); },
          [&](const Unary& unary) {
            if (unary.op == UnaryOp::Not) {
              wantFlag(*unary.operand, "`not`", known);
              return plain(Base::Flag);
            }
            const Quantity found = quantity(*unary.operand, known);
            if (!found.isNumeric())
              diagnostics_.report<diag::WrongValue>(expression.range, "`-`", "a number or a length",
                                                    text(unary.operand->range), quantityText(found));
            return found;
          },
          [&](const Binary& one) { return binary(expression, one, known); },
          [&](const Function& one) { return function(expression, one, known); },
          [&](const Given& given) {
            const auto found = symbols_.find(given.name.text);
            const Parameter* parameter = found == symbols_.end() ? nullptr : found->second.parameter;
            const auto later = later_.find(given.name.text);
            const bool isTouch = found != symbols_.end()
                                     ? found->second.role == Symbol::Role::Touch
                                     : later != later_.end() && later->second == Symbol::Role::Touch;
            if (isTouch) {
              // Whether it found anything; no where it has not been made.
              if (known.set.contains(given.name.text) && !mayMiss_.contains(given.name.text))
                diagnostics_.report<diag::GivenAlways>(given.name.range, given.name.text);
            } else if (found == symbols_.end())
              unknownName(given.name.range, given.name.text);
            else if (parameter == nullptr || !parameter->optional)
              diagnostics_.report<diag::GivenAlways>(given.name.range, given.name.text);
            if (found != symbols_.end()) found->second.read = true;
            return plain(Base::Flag);
          },
          [&](const Bracketed& bracketed) { return quantity(*bracketed.inner, known); }},
      expression.node);
}

} // namespace dotek::frontend::cycle
