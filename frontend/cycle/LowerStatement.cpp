#include "frontend/cycle/Lowering.h"
#include "frontend/cycle/Walk.h"
#include "ir/CycleNames.h"
#include "ir/Match.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace dotek::frontend::cycle {
namespace {

constexpr ir::ResultName kPositions[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                         ir::ResultName::PositionZ};
constexpr ir::ResultName kErrors[] = {ir::ResultName::ErrorX, ir::ResultName::ErrorY, ir::ResultName::ErrorZ};

// Of a step between the last value and one that counts as it: steps such as 0.1 are no sums of halves, so
// what they add up to is off by the last digits of the control.
constexpr double kReached = 0.001;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first);
}

} // namespace

ir::ToolPart partOf(ToolPart part) {
  return static_cast<ir::ToolPart>(part);
}

std::optional<ir::Axis> linear(Axis axis) {
  if (axis > Axis::Z) return std::nullopt;
  return static_cast<ir::Axis>(axis);
}

bool Lowering::ended() const {
  const auto last = std::find_if(out_->rbegin(), out_->rend(), [](const ir::CycleStatement& one) {
    return !std::holds_alternative<ir::Comment>(one.node);
  });
  return last != out_->rend() &&
         ir::match(
             *last, [](const ir::OneOf<ir::Alarm, ir::Jump, ir::Return> auto&) { return true; },
             [](const ir::OneOf<ir::Label, ir::Branch, ir::Store, ir::Comment, ir::Assign, ir::Move,
                                ir::Measure, ir::ProbePower, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                                ir::Stop, ir::CallCycle, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {
               return false;
             });
}

void Lowering::jump(ir::LabelId label, SourceRange range) {
  if (!ended()) emit(ir::Jump{label}, range);
}

void Lowering::comments(const std::vector<Comment>& list) {
  if (scope_.inlined) return;
  for (const Comment& comment : list)
    if (const std::string words = trimmed(comment.text); !words.empty())
      emit(ir::Comment{words}, comment.range);
}

Lowering::Results Lowering::block(const Block& block) {
  const std::size_t before = known_.size();
  for (const Statement& one : block.statements)
    statement(one);
  Results out(known_.begin() + static_cast<std::ptrdiff_t>(before), known_.end());
  known_.resize(before);
  comments(block.comments);
  return out;
}

void Lowering::statement(const Statement& s) {
  if (out_->size() > kMostStatements) {
    if (!failed_) refuse<diag::CycleTooLong>(s.range, kMostStatements);
    return;
  }
  const SourceRange range = s.range;
  const bool declares = std::visit(
      ir::Overloaded{
          [](const ir::OneOf<ErrorStatement, Header, Use, Needs, Parameter, Result, Require> auto&) {
            return true;
          },
          [](const ir::OneOf<ProbeSwitch, SpindleOff, Coolant, Dwell, Stop, Alarm, Report, Move, Touch,
                             SetOffset, SetTool, SetStored, Assign, If, Repeat, For, While, Call> auto&) {
            return false;
          }},
      s.node);
  if (declares) return;
  comments(s.before);
  if (s.after) comments({*s.after});
  std::visit(
      ir::Overloaded{
          [](const ir::OneOf<ErrorStatement, Header, Use, Needs, Parameter, Result, Require> auto&) {},
          [&](const ProbeSwitch& one) { probe(one, range); },
          [&](const SpindleOff&) {
            emit(ir::Spindle{ir::Spindle::State::Off, nullptr}, range);
          },
          [&](const Coolant& one) { emit(ir::Coolant{static_cast<ir::Coolant::State>(one.state)}, range); },
          [&](const Dwell& one) {
            const ir::ExpressionPtr time = value(*one.time);
            emit(ir::Dwell{time}, range);
          },
          [&](const Stop& one) {
            emit(ir::Stop{false, one.text.text, 1}, range);
          },
          [&](const Alarm& one) {
            if (!called_) leaveResults(known_, range);
            emit(ir::Alarm{one.text.text}, range);
          },
          [&](const Report& one) { report(one, range); }, [&](const Move& one) { move(one, range); },
          [&](const Touch& one) { touch(one, range); }, [&](const SetOffset& one) { setOffset(one, range); },
          [&](const SetTool& one) {
            ir::CallCycle set = quiet(ir::kSetTool);
            const ir::ToolPart part = partOf(one.part);
            set.setsTool = isLength(part);
            set.arguments.push_back({"tool", value(*one.tool), std::nullopt, ir::Kind::ToolOffset, false});
            set.arguments.push_back(
                {std::string(toolPartText(part)), value(*one.value), std::nullopt, ir::Kind::Length, false});
            emit(std::move(set), range);
            if (isLength(part)) scope_.shifted[2] = true;
          },
          [&](const SetStored& one) {
            ir::CallCycle keep = quiet(ir::kKeep);
            keep.arguments.push_back(
                {one.name.text, value(*one.value), std::nullopt, ir::Kind::Number, false});
            emit(std::move(keep), range);
          },
          [&](const Assign& one) { assign(one, range); }, [&](const If& one) { choose(one, range); },
          [&](const Repeat& one) { repeat(one, range); }, [&](const For& one) { count(one, range); },
          [&](const While& one) { loop(one, range); }, [&](const Call& one) { call(one, range); }},
      s.node);
}

void Lowering::probe(const ProbeSwitch& probe, SourceRange range) {
  if (scope_.keepsProbe) return;
  probe_ = probe.on ? Probe::On : Probe::Off;
  emit(ir::ProbePower{probe.on}, range);
}

ir::CallCycle Lowering::quiet(std::string_view name) const {
  ir::CallCycle out;
  out.cycle = std::string(name);
  out.moves = false;
  return out;
}

void Lowering::report(const Report& report, SourceRange range) {
  ir::CallCycle out = quiet(ir::kReport);
  const auto add = [&](const char* name, const ExpressionPtr& expression) {
    if (expression != nullptr)
      out.arguments.push_back({name, value(*expression), std::nullopt, ir::Kind::Number, false});
  };
  add("measured", report.measured);
  add("nominal", report.nominal);
  add("tolerance", report.tolerance);
  emit(ir::Comment{report.name.text}, range);
  emit(std::move(out), range);
}

// What the caller gets, after the last statement; before an alarm, what the operator looks at.
void Lowering::leaveResults(const Results& results, SourceRange range) {
  if (results.empty() || ended()) return;
  ir::CallCycle out = quiet(ir::kResults);
  for (const auto& [name, id] : results)
    out.arguments.push_back({name, ir::variable(id), std::nullopt, ir::Kind::Number, false});
  emit(std::move(out), range, "results");
}

void Lowering::assign(const Assign& assign, SourceRange range) {
  const auto found = scope_.names.find(assign.name.text);
  const std::vector<Name>* choices =
      found == scope_.names.end() ? choicesOf(*assign.value) : found->second.choices;
  const ir::Kind kind = kindOf(*assign.value);
  const ir::ExpressionPtr given = value(*assign.value, choices);
  if (found == scope_.names.end()) {
    Meaning meaning;
    meaning.kind = kind;
    meaning.choices = choices;
    meaning.variable = local(assign.name.text, kind, assign.name.range);
    meaning.value = ir::variable(*meaning.variable, assign.name.range);
    scope_.names[assign.name.text] = meaning;
  }
  const Meaning& meaning = scope_.names.at(assign.name.text);
  if (!meaning.variable) return;
  emit(ir::Assign{*meaning.variable, given}, range);
  const std::pair<std::string, ir::VariableId> result{assign.name.text, *meaning.variable};
  const auto among = [&](const Results& list) {
    return std::find(list.begin(), list.end(), result) != list.end();
  };
  if (among(results_) && !among(known_)) known_.push_back(result);
}

void Lowering::move(const Move& move, SourceRange range) {
  if (move.toStart) return moveToStart(move, range);
  ir::Move out;
  out.motion = static_cast<ir::Motion>(move.kind);
  for (const Coordinate& one : move.axes) {
    const auto axis = linear(one.axis);
    if (!axis) {
      refuse<diag::RotaryAxis>(one.range, std::string(1, axisLetter(one.axis)));
      return;
    }
    ir::Coordinate coordinate;
    coordinate.value = value(*one.value);
    coordinate.frame = move.reach == Reach::By                   ? ir::Frame::Here
                       : one.frame == Coordinate::Frame::Machine ? ir::Frame::Machine
                                                                 : ir::Frame::Work;
    if (one.frame == Coordinate::Frame::Work && one.system != nullptr) coordinate.system = value(*one.system);
    // The lowest point of the probe; a distance is that of any point of it.
    if (*axis == ir::Axis::Z && move.reach == Reach::To) out.point = ir::ProbePoint::Lowest;
    out.axes[ir::indexOf(*axis)] = std::move(coordinate);
  }
  if (move.feed != nullptr) out.feed = value(*move.feed);
  emit(std::move(out), range);
}

void Lowering::touch(const Touch& touch, SourceRange range) {
  if (!touch.along.empty() && touch.reach == Reach::To) {
    refuse<diag::TouchAlongTo>(range);
    return;
  }
  if (touch.along.empty() && !linear(touch.axis)) {
    refuse<diag::RotaryAxis>(range, std::string(1, axisLetter(touch.axis)));
    return;
  }
  if (touch.along.empty() && *linear(touch.axis) == ir::Axis::Z && !leadsDownward(touch, range)) return;
  if (touch.along.empty() && touch.reach == Reach::By && *linear(touch.axis) != ir::Axis::Z)
    hasWay(touch, range);
  const bool plain =
      touch.along.empty() && !touch.once && touch.overtravel == nullptr && touch.otherwise == nullptr;
  if (plain) {
    ir::Measure measure;
    measure.axis = *linear(touch.axis);
    measure.target = ir::Coordinate{value(*touch.value),
                                    touch.reach == Reach::By ? ir::Frame::Here : ir::Frame::Work, nullptr};
    emit(std::move(measure), range);
  } else {
    touchCall(touch, range);
  }
  if (touch.otherwise == nullptr) return readTouch(touch, range);
  const ir::LabelId missed = label("not_found", range), end = label("found", range);
  emit(ir::Branch{ir::compare(ir::Relation::NotEqual, ir::result(ir::ResultName::ProbeError, range),
                              ir::constant(0), range),
                  missed},
       range);
  readTouch(touch, range);
  jump(end, range);
  place(missed, range);
  noteFound(touch, false, range);
  block(*touch.otherwise);
  place(end, range);
}

// A touch that says how it searches.
void Lowering::touchCall(const Touch& touch, SourceRange range) {
  ir::CallCycle out;
  const auto add = [&](std::string name, ir::ExpressionPtr given, ir::Kind kind,
                       std::optional<ir::Frame> frame = std::nullopt) {
    out.arguments.push_back({std::move(name), std::move(given), frame, kind, true});
  };
  if (touch.along.empty()) {
    const ir::Axis axis = *linear(touch.axis);
    out.cycle = std::string(ir::kSurface);
    out.axis = axis;
    add(std::string("target ") + "xyz"[ir::indexOf(axis)], value(*touch.value), ir::Kind::Length,
        touch.reach == Reach::By ? ir::Frame::Here : ir::Frame::Work);
    out.results = {kPositions[ir::indexOf(axis)], kErrors[ir::indexOf(axis)]};
  } else {
    out.cycle = std::string(ir::kSurfaceAlong);
    for (const Coordinate& part : touch.along)
      if (const auto axis = linear(part.axis))
        add(std::string("direction ") + "xyz"[ir::indexOf(*axis)], value(*part.value), ir::Kind::Number);
    add("travel", value(*touch.value), ir::Kind::Length);
    out.results = {std::begin(kPositions), std::end(kPositions)};
    out.results.push_back(ir::ResultName::Main);
  }
  if (touch.overtravel != nullptr) add("overtravel", value(*touch.overtravel), ir::Kind::Length);
  if (touch.once) add("once", ir::constant(1, range), ir::Kind::Flag);
  if (touch.otherwise != nullptr) {
    add("miss", ir::constant(1, range), ir::Kind::Flag);
    out.results.push_back(ir::ResultName::ProbeError);
  }
  emit(std::move(out), range);
}

void Lowering::readTouch(const Touch& touch, SourceRange range) {
  if (!touch.name) return;
  Meaning& meaning = scope_.names[touch.name->text];
  const auto read = [&](const std::string& part, ir::ResultName result) {
    Meaning& one = meaning.members[part];
    if (!one.variable) {
      one.kind = ir::Kind::Length;
      one.variable = local(touch.name->text + "_" + part, ir::Kind::Length, touch.name->range);
      one.value = ir::variable(*one.variable, touch.name->range);
      touched_.insert(*one.variable);
    }
    emit(ir::Assign{*one.variable, ir::result(result, range)}, range);
  };
  if (touch.along.empty()) {
    const std::size_t i = ir::indexOf(*linear(touch.axis));
    read("at", kPositions[i]);
    read("error", kErrors[i]);
  } else {
    read("at_x", ir::ResultName::PositionX);
    read("at_y", ir::ResultName::PositionY);
    read("at_z", ir::ResultName::PositionZ);
    read("error", ir::ResultName::Main);
  }
  noteFound(touch, true, range);
}

void Lowering::declareTouches(const Block& block) {
  eachStatement(block, [&](const Statement& one) {
    const auto* touch = std::get_if<Touch>(&one.node);
    if (touch == nullptr || !touch->name) return;
    const auto [at, isNew] = scope_.names.try_emplace(foundName(touch->name->text));
    if (!isNew) return;
    Meaning& found = at->second;
    found.kind = ir::Kind::Flag;
    found.variable = local(touch->name->text + "_found", found.kind, touch->name->range);
    found.value = ir::variable(*found.variable, touch->name->range);
    touched_.insert(*found.variable);
    noteFound(*touch, false, touch->name->range);
  });
}

void Lowering::noteFound(const Touch& touch, bool found, SourceRange range) {
  if (!touch.name) return;
  const auto at = scope_.names.find(foundName(touch.name->text));
  if (at != scope_.names.end()) emit(ir::Assign{*at->second.variable, ir::constant(found ? 1 : 0)}, range);
}

void Lowering::setOffset(const SetOffset& set, SourceRange range) {
  ir::CallCycle out = quiet(ir::kSetOffset);
  out.setting.emplace();
  out.setting->system = value(*set.system);
  for (const Becomes& item : set.items) {
    const auto axis = linear(item.axis);
    if (!axis) {
      refuse<diag::RotaryAxis>(range, std::string(1, axisLetter(item.axis)));
      return;
    }
    const std::size_t i = ir::indexOf(*axis);
    out.arguments.push_back(
        {std::string("measured ") + "xyz"[i], value(*item.value), std::nullopt, ir::Kind::Length, false});
    out.setting->axes[i] = true;
    out.setting->nominal[i] = value(*item.coordinate);
    scope_.shifted[i] = true;
  }
  emit(std::move(out), range);
}

void Lowering::choose(const If& choice, SourceRange range) {
  const ir::LabelId end = label("end_if", range);
  const Probe before = probe_;
  std::optional<Probe> after; // on every path so far
  ++nested_;
  std::optional<Results> given; // on every path so far
  const auto leave = [&](const Results& here) {
    const bool gone = ended();
    if (!gone) after = !after || *after == probe_ ? probe_ : Probe::Either;
    probe_ = before;
    if (gone) return;
    if (!given) given = here;
    std::erase_if(*given,
                  [&](const auto& one) { return std::find(here.begin(), here.end(), one) == here.end(); });
  };
  bool open = true; // a path leads to the part
  for (const If::Part& part : choice.parts) {
    comments(part.comments);
    const auto known = decided(*part.condition);
    if (!open || known == false) continue;
    const ir::LabelId next = label("otherwise", range);
    if (!known) branch(*part.condition, false, next);
    leave(block(part.body));
    if (known) {
      open = false;
      continue;
    }
    jump(end, range);
    place(next, range);
  }
  comments(choice.elseComments);
  if (open) leave(choice.otherwise != nullptr ? block(*choice.otherwise) : Results{});
  if (given) known_.insert(known_.end(), given->begin(), given->end());
  probe_ = after.value_or(before);
  --nested_;
  place(end, range);
}

// A `set` in the body is before what the next run reads.
void Lowering::loopBody(const Block& body) {
  const Probe before = probe_;
  noteShifts(body, {});
  ++nested_;
  block(body);
  --nested_;
  if (probe_ != before) probe_ = Probe::Either;
}

void Lowering::repeat(const Repeat& repeat, SourceRange range) {
  const ir::ExpressionPtr times = kept(value(*repeat.count), "times", ir::Kind::Number, range);
  const ir::VariableId done = local("runs", ir::Kind::Number, range);
  const ir::LabelId begin = label("loop", range), end = label("loop_end", range);
  emit(ir::Assign{done, ir::constant(0)}, range);
  place(begin, range);
  emit(ir::Branch{ir::compare(ir::Relation::GreaterEqual, ir::variable(done), times, range), end}, range);
  loopBody(repeat.body);
  emit(ir::Assign{done, ir::binary(ir::BinaryOp::Add, ir::variable(done), ir::constant(1))}, range);
  emit(ir::Jump{begin}, range);
  place(end, range);
}

// Whole numbers add up exactly on every control.
bool Lowering::isWhole(const Expression& expression) const {
  if (const auto* number = std::get_if<Number>(&expression.node))
    return number->unit != Unit::Inch && number->value == std::floor(number->value);
  if (const auto* one = std::get_if<Unary>(&expression.node)) return isWhole(*one->operand);
  if (const auto* one = std::get_if<Bracketed>(&expression.node)) return isWhole(*one->inner);
  if (const auto* both = std::get_if<Binary>(&expression.node))
    return both->op != BinaryOp::Divide && isWhole(*both->left) && isWhole(*both->right);
  if (const auto* called = std::get_if<Function>(&expression.node))
    return called->name.text == "round" || called->name.text == "down" || called->name.text == "up";
  const Meaning* const meaning = meaningOf(expression);
  return meaning != nullptr && meaning->kind == ir::Kind::Count;
}

void Lowering::count(const For& loop, SourceRange range) {
  const ir::Kind kind = kindOf(*loop.first);
  const bool exact =
      isWhole(*loop.first) && isWhole(*loop.last) && (loop.step == nullptr || isWhole(*loop.step));
  const ir::ExpressionPtr first = value(*loop.first);
  ir::ExpressionPtr bound = value(*loop.last);
  const ir::ExpressionPtr step =
      loop.step == nullptr ? ir::constant(1) : kept(value(*loop.step), "step", kind, range);
  if (!exact) {
    const double *to = ir::constantValue(bound), *by = ir::constantValue(step);
    const ir::ExpressionPtr more =
        by != nullptr ? ir::constant(*by * kReached)
                      : ir::binary(ir::BinaryOp::Multiply, step, ir::constant(kReached), range);
    bound = to != nullptr && by != nullptr ? ir::constant(*to + *by * kReached)
                                           : ir::binary(ir::BinaryOp::Add, bound, more, range);
  }
  const ir::ExpressionPtr last = kept(bound, "last", kind, range);
  const auto named = scope_.names.find(loop.name.text);
  const ir::VariableId id = named != scope_.names.end() && named->second.variable
                                ? *named->second.variable
                                : local(loop.name.text, kind, loop.name.range);
  Meaning meaning;
  meaning.kind = kind;
  meaning.variable = id;
  meaning.value = ir::variable(id, loop.name.range);
  scope_.names[loop.name.text] = meaning;
  const ir::LabelId begin = label("loop", range), end = label("loop_end", range);
  const auto beyond = [&](ir::Relation relation) {
    emit(ir::Branch{ir::compare(relation, ir::variable(id), last, range), end}, range);
  };
  emit(ir::Assign{id, first}, range);
  place(begin, range);
  const double* known = ir::constantValue(step);
  if (known != nullptr) {
    beyond(*known < 0 ? ir::Relation::Less : ir::Relation::Greater);
  } else {
    const ir::LabelId falls = label("falls", range), inside = label("inside", range);
    emit(ir::Branch{ir::compare(ir::Relation::Less, step, ir::constant(0), range), falls}, range);
    beyond(ir::Relation::Greater);
    emit(ir::Jump{inside}, range);
    place(falls, range);
    beyond(ir::Relation::Less);
    place(inside, range);
  }
  loopBody(loop.body);
  if (known != nullptr && *known == 0)
    emit(ir::Jump{end}, range); // it would never end
  else if (known == nullptr)
    emit(ir::Branch{ir::compare(ir::Relation::Equal, step, ir::constant(0), range), end}, range);
  emit(ir::Assign{id, ir::binary(ir::BinaryOp::Add, ir::variable(id), step)}, range);
  emit(ir::Jump{begin}, range);
  place(end, range);
}

void Lowering::loop(const While& loop, SourceRange range) {
  const ir::ExpressionPtr most = kept(value(*loop.most), "most", ir::Kind::Number, range);
  const ir::VariableId done = local("runs", ir::Kind::Number, range);
  const ir::LabelId begin = label("loop", range), end = label("loop_end", range);
  emit(ir::Assign{done, ir::constant(0)}, range);
  place(begin, range);
  branch(*loop.condition, false, end);
  emit(ir::Branch{ir::compare(ir::Relation::GreaterEqual, ir::variable(done), most, range), end}, range);
  loopBody(loop.body);
  emit(ir::Assign{done, ir::binary(ir::BinaryOp::Add, ir::variable(done), ir::constant(1))}, range);
  emit(ir::Jump{begin}, range);
  place(end, range);
}

} // namespace dotek::frontend::cycle
