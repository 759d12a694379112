#include "frontend/cycle/Checker.h"
#include "frontend/cycle/Walk.h"
#include "frontend/cycle/Words.h"
#include "ir/Match.h"
#include "support/Ascii.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace dotek::frontend::cycle {

using Base = Quantity::Base;

namespace {

Quantity plain(Base base) {
  return {base, 1, nullptr};
}

using Names = std::set<std::string, std::less<>>;

Names common(const Names& a, const Names& b) {
  Names out;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(out, out.end()));
  return out;
}

bool isWhole(double value) {
  return std::floor(value) == value;
}

using MaybeProbe = std::optional<ProbeState>; // nullopt: no path gets there

MaybeProbe joinedProbe(MaybeProbe a, MaybeProbe b) {
  if (!a || !b) return a ? a : b;
  return *a == *b ? a : ProbeState::Either;
}

MaybeProbe probeAfter(const Block& block, ProbeState before);

MaybeProbe probeAfter(const Statement& statement, ProbeState before) {
  const auto loop = [&](const Block& body) { return joinedProbe(before, probeAfter(body, before)); };
  if (const auto* probe = std::get_if<ProbeSwitch>(&statement.node))
    return probe->on ? ProbeState::On : ProbeState::Off;
  if (std::holds_alternative<Alarm>(statement.node)) return std::nullopt;
  if (const auto* repeat = std::get_if<Repeat>(&statement.node)) return loop(repeat->body);
  if (const auto* counted = std::get_if<For>(&statement.node)) return loop(counted->body);
  if (const auto* asked = std::get_if<While>(&statement.node)) return loop(asked->body);
  if (const auto* touch = std::get_if<Touch>(&statement.node);
      touch != nullptr && touch->otherwise != nullptr)
    return loop(*touch->otherwise);
  const auto* choice = std::get_if<If>(&statement.node);
  if (choice == nullptr) return before;
  MaybeProbe after = choice->otherwise == nullptr ? before : probeAfter(*choice->otherwise, before);
  for (const If::Part& part : choice->parts)
    after = joinedProbe(after, probeAfter(part.body, before));
  return after;
}

// What is known of the probe after a block. Nothing is reported.
MaybeProbe probeAfter(const Block& block, ProbeState before) {
  MaybeProbe state = before;
  for (const Statement& statement : block.statements)
    if (state) state = probeAfter(statement, *state);
  return state;
}

} // namespace

std::optional<double> constant(const ExpressionPtr& expression) {
  if (expression == nullptr) return std::nullopt;
  if (const auto* bracketed = std::get_if<Bracketed>(&expression->node)) return constant(bracketed->inner);
  if (const auto* unary = std::get_if<Unary>(&expression->node); unary != nullptr) {
    const std::optional<double> value = constant(unary->operand);
    return value && unary->op == UnaryOp::Negate ? std::optional(-*value) : std::nullopt;
  }
  const auto* number = std::get_if<Number>(&expression->node);
  if (number == nullptr) return std::nullopt;
  const bool inch = number->unit == Unit::Inch || number->unit == Unit::InchPerMinute;
  return inch ? number->value * 25.4 : number->value;
}

void Checker::wantConstant(const ExpressionPtr& expression, bool (*takes)(double), std::string_view what,
                           std::string_view wanted) {
  const std::optional<double> value = constant(expression);
  if (value && !takes(*value))
    diagnostics_.report<diag::ConstantOutside>(expression->range, what, wanted, text(expression->range));
}

void Checker::wantCount(const ExpressionPtr& expression, std::string_view what) {
  wantConstant(
      expression, [](double value) { return value >= 1 && isWhole(value); }, what, "a whole number from 1");
}

void Checker::constants(const Parameter& parameter) {
  if (parameter.type.name == TypeName::Count)
    wantConstant(parameter.value, isWhole, "a count", "a whole number");
  for (const Clause& clause : parameter.clauses) {
    if (clause.kind != Clause::Kind::Range) continue;
    const std::optional<double> least = constant(clause.first), largest = constant(clause.second);
    if (least && largest && *least > *largest)
      diagnostics_.report<diag::ConstantOutside>(clause.range, "`range`",
                                                 "the least value and then the largest", text(clause.range));
  }
}

Known joined(const Known& a, const Known& b) {
  if (a.ended) return b;
  if (b.ended) return a;
  return {common(a.set, b.set), common(a.given, b.given), a.probe == b.probe ? a.probe : ProbeState::Either,
          false};
}

void Checker::gives(const Name& name, Symbol symbol, Known& known) {
  symbol.range = name.range;
  const auto [at, isNew] = symbols_.try_emplace(name.text, symbol);
  Symbol& old = at->second;
  if (!isNew && (old.role != symbol.role || !old.range.hasPlace())) {
    // A name that was only read so far was reported there.
    if (old.role == Symbol::Role::Host && old.range == SourceRange())
      diagnostics_.report<diag::HostName>(name.range, name.text, proposeName("my_" + name.text));
    else if (old.range.hasPlace())
      diagnostics_.report<diag::NameDeclaredTwice>(name.range, name.text)
          .note(old.range, "the first is here");
    else
      old = symbol;
    return;
  }
  if (!isNew) {
    old.direction = old.direction || symbol.direction;
    old.cycle = symbol.cycle;
    if (symbol.role == Symbol::Role::Counter) old.quantity = symbol.quantity;
  }
  known.set.insert(name.text);
}

void Checker::assign(const Assign& assign, Known& known) {
  const Quantity found = [&] {
    const auto at = symbols_.find(assign.name.text);
    const bool isChoice = at != symbols_.end() && at->second.quantity.base == Base::Choice;
    return isChoice ? choice(*assign.value, at->second.quantity, known) : quantity(*assign.value, known);
  }();
  const auto at = symbols_.find(assign.name.text);
  if (at == symbols_.end() || (!at->second.range.hasPlace() && at->second.role != Symbol::Role::Host)) {
    Symbol symbol;
    symbol.quantity = found;
    symbol.range = assign.name.range;
    symbols_[assign.name.text] = symbol;
    known.set.insert(assign.name.text);
    return;
  }
  Symbol& symbol = at->second;
  switch (symbol.role) {
  case Symbol::Role::Local:
    if (symbol.quantity.base == Base::Zero) symbol.quantity = found;
    break;
  case Symbol::Role::Result: break;
  case Symbol::Role::Parameter:
    diagnostics_.report<diag::ParameterWritten>(assign.name.range, assign.name.text,
                                                proposeName("used_" + assign.name.text));
    return;
  case Symbol::Role::Counter:
  case Symbol::Role::Touch:
  case Symbol::Role::Call:
    diagnostics_.report<diag::NameDeclaredTwice>(assign.name.range, assign.name.text)
        .note(symbol.range, "the first is here");
    return;
  case Symbol::Role::Host:
    diagnostics_.report<diag::HostName>(assign.name.range, assign.name.text,
                                        proposeName("my_" + assign.name.text));
    return;
  }
  if (!found.fits(symbol.quantity)) {
    if (std::get_if<Number>(&assign.value->node) != nullptr && !unitFor(symbol.quantity).empty())
      want(*assign.value, symbol.quantity, "`" + assign.name.text + "`", known);
    else
      diagnostics_.report<diag::WrongValue>(assign.value->range, "`" + assign.name.text + "`",
                                            quantityText(symbol.quantity), text(assign.value->range),
                                            quantityText(found));
  }
  known.set.insert(assign.name.text);
}

void Checker::touch(const Touch& touch, const Statement& statement, Known& known) {
  const bool wasRead = !std::holds_alternative<Missing>(touch.value->node);
  if (wasRead && known.probe != ProbeState::On && !known.ended)
    diagnostics_.report<diag::TouchWithProbeOff>(statement.range, "touches",
                                                 known.probe == ProbeState::Off ? "" : " on some paths");
  if (touch.along.empty() && touch.axis > Axis::Z)
    diagnostics_.report<diag::RotaryTouch>(statement.range, axisLetter(touch.axis));
  for (const Coordinate& part : touch.along) {
    if (part.axis > Axis::Z) diagnostics_.report<diag::RotaryTouch>(part.range, axisLetter(part.axis));
    const Quantity found = quantity(*part.value, known);
    if (!found.fits(plain(Base::Number)) && !found.fits(plain(Base::Length)))
      diagnostics_.report<diag::WrongValue>(part.value->range, "the direction", "a number or a length",
                                            text(part.value->range), quantityText(found));
  }
  want(*touch.value, plain(Base::Length), touch.reach == Reach::By ? "the distance" : "the coordinate",
       known);
  if (touch.reach == Reach::By && constant(touch.value) == 0.0)
    diagnostics_.report<diag::TouchWithoutDirection>(touch.value->range);
  const auto isZero = [](const Coordinate& part) { return constant(part.value) == 0.0; };
  if (!touch.along.empty() && std::all_of(touch.along.begin(), touch.along.end(), isZero)) {
    const SourceRange all{touch.along.front().range.file, touch.along.front().range.begin,
                          touch.along.back().range.end};
    diagnostics_.report<diag::ConstantOutside>(all, "`along`", "a direction with a part that is not 0",
                                               text(all));
  }
  if (touch.overtravel != nullptr) want(*touch.overtravel, plain(Base::Length), "the overtravel", known);
  if (touch.otherwise != nullptr) {
    Known missed = known;
    Known found = known;
    if (touch.name) missed.given.erase(touch.name->text);
    block(*touch.otherwise, missed);
    if (touch.name) {
      Symbol symbol;
      symbol.role = Symbol::Role::Touch;
      symbol.direction = !touch.along.empty();
      gives(*touch.name, symbol, found);
    }
    known = joined(found, missed);
  } else if (touch.name) {
    Symbol symbol;
    symbol.role = Symbol::Role::Touch;
    symbol.direction = !touch.along.empty();
    gives(*touch.name, symbol, known);
  }
}

void Checker::move(const Move& move, const Statement& statement, Known& known) {
  if (move.kind == Move::Kind::Protected && known.probe != ProbeState::On && !known.ended)
    diagnostics_.report<diag::TouchWithProbeOff>(statement.range, "protects",
                                                 known.probe == ProbeState::Off ? "" : " on some paths");
  Names axes;
  for (const Coordinate& one : move.axes) {
    wantAxis(*one.value, one.axis, move.reach == Reach::By ? "the distance" : "the coordinate", known);
    if (one.system != nullptr) want(*one.system, plain(Base::WorkOffset), "`work`", known);
    if (!axes.insert(std::string(1, axisLetter(one.axis))).second)
      diagnostics_.report<diag::AxisTwice>(one.range, axisLetter(one.axis));
    if (move.reach == Reach::By && one.frame != Coordinate::Frame::Active)
      diagnostics_.report<diag::FrameOfDistance>(one.range);
  }
  if (move.feed == nullptr) return;
  want(*move.feed, plain(Base::Feed), "`feed`", known);
  if (move.kind == Move::Kind::Rapid) diagnostics_.report<diag::RapidWithFeed>(move.feed->range);
}

void Checker::forgetTouches(const Block& body, Known& known) const {
  eachStatement(body, [&](const Statement& one) {
    const auto* touch = std::get_if<Touch>(&one.node);
    if (touch != nullptr && touch->name && touch->otherwise != nullptr) known.given.erase(touch->name->text);
  });
}

void Checker::loopBody(const Block& body, Known& known, bool runsOnce) {
  const Known before = known;
  Known within = before;
  // What the body leaves is what its next run begins with.
  const std::optional<ProbeState> again = probeAfter(body, before.probe);
  if (again && *again != before.probe) within.probe = ProbeState::Either;
  block(body, within);
  if (runsOnce)
    known = within.ended ? within : Known{within.set, within.given, within.probe, false};
  else
    known = joined(before, within);
}

void Checker::block(const Block& all, Known& known) {
  ++depth_;
  if (!file_.hasErrorNodes) slips(all);
  for (const Statement& one : all.statements) {
    if (known.ended) {
      // Of a block without its `end` nobody knows where it is over.
      if (!file_.hasErrorNodes) diagnostics_.report<diag::NeverReached>(one.range);
      break;
    }
    statement(one, known);
  }
  --depth_;
}

void Checker::statement(const Statement& s, Known& known) {
  std::visit(
      ir::Overloaded{
          [&](const ErrorStatement&) {
            // The probe may be switched by it, and what touches after that is no further mistake.
            for (const std::string& word : wordsOf(sources_.text(s.range)))
              if (lowerCase(word).starts_with("probe")) known.probe = ProbeState::On;
          },
          [](const ir::OneOf<Header, SpindleOff, Coolant, Stop> auto&) {},
          [&](const ir::OneOf<Use, Needs, Parameter, Result, Require> auto&) {
            // Those of the file itself are taken before.
            if (depth_ > 1) diagnostics_.report<diag::LateDeclaration>(s.range);
          },
          [&](const ProbeSwitch& probe) {
            if (needsProbe_) diagnostics_.report<diag::ProbeOfCaller>(s.range);
            known.probe = probe.on ? ProbeState::On : ProbeState::Off;
          },
          [&](const Dwell& dwell) {
            want(*dwell.time, plain(Base::Time), "`dwell`", known);
            wantConstant(
                dwell.time, [](double value) { return value >= 0; }, "`dwell`",
                "a time that is not negative");
          },
          [&](const Alarm&) { known.ended = true; },
          [&](const Report& report) {
            const Quantity measured = quantity(*report.measured, known);
            if (!measured.isNumeric())
              diagnostics_.report<diag::WrongValue>(report.measured->range, "`measured`",
                                                    "a number or a length", text(report.measured->range),
                                                    quantityText(measured));
            if (report.nominal != nullptr) want(*report.nominal, measured, "`nominal`", known);
            if (report.tolerance != nullptr) want(*report.tolerance, measured, "`tolerance`", known);
          },
          [&](const Move& one) { move(one, s, known); }, [&](const Touch& one) { touch(one, s, known); },
          [&](const SetOffset& set) {
            want(*set.system, plain(Base::WorkOffset), "`set`", known);
            Names axes;
            for (const Becomes& item : set.items) {
              wantAxis(*item.value, item.axis, "the measured value", known);
              wantAxis(*item.coordinate, item.axis, "the coordinate", known);
              if (!axes.insert(std::string(1, axisLetter(item.axis))).second)
                diagnostics_.report<diag::AxisTwice>(item.coordinate->range, axisLetter(item.axis));
            }
          },
          [&](const SetTool& set) {
            want(*set.tool, plain(Base::ToolOffset), "`set tool`", known);
            want(*set.value, plain(Base::Length), fmt::format("`{}`", toolPartText(set.part)), known);
          },
          [&](const SetStored& set) {
            const Quantity found = quantity(*set.value, known);
            if (!found.isNumeric())
              diagnostics_.report<diag::WrongValue>(set.value->range, "`set stored`", "a number or a length",
                                                    text(set.value->range), quantityText(found));
          },
          [&](const Assign& one) { assign(one, known); },
          [&](const If& choice) {
            Known rest = known;
            Known after;
            after.ended = true;
            for (const If::Part& part : choice.parts) {
              wantFlag(*part.condition, "`if`", rest);
              Known within = rest;
              addGiven(*part.condition, true, within);
              block(part.body, within);
              after = joined(after, within);
              addGiven(*part.condition, false, rest);
            }
            if (choice.otherwise != nullptr) block(*choice.otherwise, rest);
            known = joined(after, rest);
            known.ended = after.ended && rest.ended;
          },
          [&](const Repeat& repeat) {
            want(*repeat.count, plain(Base::Number), "`repeat`", known);
            wantCount(repeat.count, "`repeat`");
            forgetTouches(repeat.body, known);
            loopBody(repeat.body, known, constant(repeat.count) >= 1.0);
          },
          [&](const For& loop) {
            const Quantity first = quantity(*loop.first, known);
            want(*loop.last, first, "the last value", known);
            if (loop.step != nullptr) want(*loop.step, first, "`step`", known);
            wantConstant(
                loop.step, [](double value) { return value != 0; }, "`step`", "a step that is not 0");
            Symbol counter;
            counter.role = Symbol::Role::Counter;
            counter.quantity = first.base == Base::Zero ? quantity(*loop.last, known) : first;
            counter.read = true;
            gives(loop.name, counter, known);
            const std::optional<double> from = constant(loop.first), to = constant(loop.last);
            forgetTouches(loop.body, known);
            loopBody(loop.body, known, from && to && *from <= *to && loop.step == nullptr);
            known.set.erase(loop.name.text);
          },
          [&](const While& loop) {
            forgetTouches(loop.body, known);
            wantFlag(*loop.condition, "`while`", known);
            want(*loop.most, plain(Base::Number), "`at most`", known);
            wantCount(loop.most, "`at most`");
            Known within = known;
            addGiven(*loop.condition, true, within);
            loopBody(loop.body, within, false);
            known = joined(known, within);
          },
          [&](const Call& one) { call(one, known); }},
      s.node);
}

void Checker::finish(const Known& known, SourceRange where) {
  // A line that could not be read may be the one that switches it, or gives a result.
  if (known.ended || file_.hasErrorNodes) return;
  if (!needsProbe_ && known.probe != ProbeState::Off)
    diagnostics_.report<diag::ProbeLeftOn>(where,
                                           known.probe == ProbeState::On ? "" : ", at least on some paths");
  for (const auto& [name, symbol] : symbols_)
    if (symbol.role == Symbol::Role::Result && !known.set.contains(name))
      diagnostics_.report<diag::ResultNotSet>(symbol.range, name);
}

} // namespace dotek::frontend::cycle
