#include "frontend/gibbs/Lower.h"
#include "frontend/gibbs/LowerEmit.h"
#include "frontend/gibbs/LowerFlatten.h"
#include "frontend/gibbs/LowerTerms.h"
#include "frontend/gibbs/LowerTouch.h"
#include "support/messages/Gibbs.h"
#include "support/messages/Path.h"
#include "support/messages/Sim.h"

#include <algorithm>

namespace dotek::frontend::gibbs {
namespace {

class PathLowering {
public:
  PathLowering(const Macro& toolPath, ir::Cycle& cycle, LowerContext& context)
      : macro_(toolPath), cycle_(cycle), context_(context),
        flat_(Flattener(cycle, context, Purpose::ToolPath).flatten(toolPath)) {}

  bool run() {
    cycle_.measurementStated = false;
    if (!findTouches()) return false;
    for (const FlatStep& each : flat_.steps)
      if (const auto* assign = std::get_if<FlatAssign>(&each.step)) assigned_.insert(assign->variable);
    TouchNotes notes(flat_, forced_, hostVariable("tool_radius"), true);
    if (!walkAll(notes) || !ends() || !judged(notes)) return false;
    notes_ = &notes;
    cycle_.body = emitStatements(
        flat_, walk_,
        {{}, options_.unsetZero, [&](std::size_t step, const FlatMove& move) { return emit(step, move); }},
        cycle_);
    if (!ok_) {
      cycle_.body.clear();
      return false;
    }
    for (const auto& [at, behind] : walk_.behind)
      context_.diagnostics.report<diag::MessageInforms>(flat_.steps[at].range,
                                                        std::get<FlatMessage>(flat_.steps[at].step).text);
    reportFields();
    return true;
  }

private:
  template <class Id, class... Args> void refuse(SourceRange range, const Args&... args) {
    context_.diagnostics.report<Id>(range, args...);
    ok_ = false;
  }

  // kNoVariable where no line has asked for it.
  ir::VariableId hostVariable(std::string_view name) const {
    for (ir::VariableId id = 0; id < cycle_.variables.size(); ++id)
      if (cycle_.variables[id].role == ir::Role::Host && cycle_.variables[id].name == name) return id;
    return kNoVariable;
  }

  // ---- what the walk finds

  bool findTouches() {
    for (const SourceRange& line : context_.touches) {
      bool found = false;
      for (std::size_t at = 0; at < flat_.steps.size(); ++at) {
        const SourceRange range = flat_.steps[at].range;
        if (!std::holds_alternative<FlatMove>(flat_.steps[at].step) || range.file != line.file ||
            range.begin > line.end || line.begin > range.end)
          continue;
        forced_.insert(at);
        found = true;
      }
      if (!found) refuse<diag::NoMoveHere>(line);
    }
    return ok_;
  }

  // All that conditions tell first; where that gives too many paths, less.
  bool walkAll(TouchNotes& notes) {
    options_.unsetZero = context_.assumptions.contains("unset-zero");
    struct Effort {
      bool facts, forget, places;
    };
    for (const Effort& effort : {Effort{true, false, true}, Effort{true, true, true},
                                 Effort{true, true, false}, Effort{false, true, false}}) {
      options_.facts = effort.facts;
      options_.forget = effort.forget;
      notes = TouchNotes(flat_, forced_, hostVariable("tool_radius"), effort.places);
      options_.observer = &notes;
      walk_ = Walk(flat_, cycle_, context_.limits, options_).run();
      if (walk_.complete) break;
    }
    if (!walk_.complete) refuse<diag::TooManyPaths>({macro_.file, 0, 0}, context_.limits.paths);
    for (const Diagnostic& refusal : walk_.refusals) {
      context_.diagnostics.add(refusal);
      ok_ = false;
    }
    return ok_;
  }

  bool ends() {
    for (const auto& [at, codes] : walk_.codes) {
      if (std::holds_alternative<FlatEnd>(flat_.steps[at].step)) {
        refuse<diag::ToolPathStopped>(flat_.steps[at].range);
        continue;
      }
      for (const std::size_t code : codes)
        refuse<diag::ReturnCodeSet>(code == kNowhere ? SourceRange{macro_.file, 0, 0}
                                                     : flat_.steps[code].range);
    }
    const std::size_t endless = endlessStep(flat_, walk_, {});
    if (ok_ && endless != kNowhere) refuse<diag::GoesRoundForEver>(flat_.steps[endless].range);
    return ok_;
  }

  ReversalTrace reversals() {
    WalkOptions options = options_;
    options.facts = true;
    for (ir::VariableId id = 0; id < cycle_.variables.size(); ++id) {
      const ir::Variable& variable = cycle_.variables[id];
      if (variable.role == ir::Role::Parameter) options.values[id] = variable.defaultValue.value_or(0);
      if (variable.role == ir::Role::Host) options.values[id] = variable.name == "tool_radius" ? 1 : 0;
    }
    ReversalTrace trace(flat_, forced_);
    options.observer = &trace;
    Walk(flat_, cycle_, context_.limits, options).run();
    return trace;
  }

  bool judged(const TouchNotes& notes) {
    for (const std::size_t step : notes.withoutReturn())
      notShown(step, "the path does not come back to where it began");
    for (const std::size_t step : notes.oneSided())
      notShown(step,
               "the contact may lie where this move begins, and no move asks for the other side; the path "
               "goes back along the same axis");
    const auto candidates = notes.candidates();
    const ReversalTrace trace = reversals();
    std::set<std::size_t> oblique = notes.oblique();
    oblique.insert(trace.oblique().begin(), trace.oblique().end());
    for (const std::size_t step : oblique)
      refuse<diag::TouchOblique>(flat_.steps[step].range);
    for (const auto& [run, steps] : candidates) {
      const bool tells = std::any_of(steps.begin(), steps.end(),
                                     [&](std::size_t step) { return trace.reversals().contains(step); });
      for (const std::size_t step : steps) {
        const bool turns = trace.reversals().contains(step);
        if (!turns && trace.rises().contains(step)) {
          refuse<diag::RetractNotShown>(flat_.steps[step].range);
          continue;
        }
        if (tells && !turns) continue;
        notShown(step, tells ? "the path goes back along the same axis"
                             : "the path may go back along the same axis");
      }
    }
    return ok_;
  }

  void notShown(std::size_t step, std::string_view what) {
    const SourceRange range = flat_.steps[step].range;
    const SourceFile& file = context_.sources.file(range.file);
    refuse<diag::TouchNotShown>(range, what, file.name(), file.lineOf(range.begin));
  }

  // ---- coordinates

  // A linear form as an expression; null pointer where it depends on more than arguments.
  ir::ExpressionPtr expressionOf(const std::optional<Value>& value, SourceRange range) const {
    if (!value) return nullptr;
    if (const double* number = std::get_if<double>(&*value)) return ir::constant(*number, range);
    const Unknown& unknown = *unknownIn(*value);
    std::vector<Term> sum;
    for (const auto& [symbol, factor] : unknown.terms) {
      if (symbol.kind != Symbol::Kind::Variable) return nullptr;
      const auto id = static_cast<ir::VariableId>(symbol.number);
      if (cycle_.variables[id].role == ir::Role::Local || assigned_.contains(id)) return nullptr;
      ir::ExpressionPtr term = ir::variable(id, range);
      const double size = factor < 0 ? -factor : factor;
      if (size != 1) term = ir::binary(ir::BinaryOp::Multiply, ir::constant(size, range), term, range);
      addTerm(sum, factor < 0, term);
    }
    const double constant = unknown.constant;
    addTerm(sum, constant < 0, ir::constant(constant < 0 ? -constant : constant, range));
    return sumOf(sum, range);
  }

  // `written` counts from the entry (X, Y) or the retract plane (Z); where it takes just that away again, it
  // is a work coordinate.
  ir::Coordinate coordinate(ir::Axis axis, const ir::ExpressionPtr& written,
                            const std::optional<Value>& form) const {
    constexpr std::array<std::string_view, 3> kOrigins = {"start_x", "start_y", "retract"};
    const ir::VariableId origin = hostVariable(kOrigins[ir::indexOf(axis)]);
    const ir::Frame own = axis == ir::Axis::Z ? ir::Frame::Retract : ir::Frame::Start;
    if (origin == kNoVariable) return {written, own, nullptr};
    std::vector<Term> sum = terms(written);
    if (count(sum, origin) == -1) {
      addTerm(sum, false, ir::variable(origin));
      return {sumOf(sum, written->range), ir::Frame::Work, nullptr};
    }
    if (!form || factorOf(Symbol::variable(origin), *form) != -1) return {written, own, nullptr};
    const auto rest = linear(*form, 1, sourceValue(Symbol::variable(origin)), 1);
    const ir::ExpressionPtr work = expressionOf(rest, written->range);
    if (!work) return {written, own, nullptr};
    return {work, ir::Frame::Work, nullptr};
  }

  // ---- statements

  std::vector<Emitted> emit(std::size_t step, const FlatMove& move) {
    const MoveNotes& notes = notes_->of(step);
    if (notes_->isForced(step)) return forced(step, move, notes);
    if (!notes.shown.empty()) return shown(step, move, notes);
    if (notes.returns && notes.alwaysIdle) return {}; // the measurement has come back
    return {plain(step, move, notes)};
  }

  Emitted plain(std::size_t step, const FlatMove& move, const MoveNotes& notes) {
    ir::Move made;
    made.motion = ir::Motion::Protected;
    for (const ir::Axis axis : ir::kAxes) {
      const std::size_t at = ir::indexOf(axis);
      if (move.axes[at]) made.axes[at] = coordinate(axis, move.axes[at], notes.target[at].value);
    }
    made.point = move.axes[2] ? ir::ProbePoint::Lowest : ir::ProbePoint::Centre;
    return {statementOf(std::move(made), flat_.steps[step].range), kNowhere, false};
  }

  static ir::Axis axisOf(const FlatMove& move, const MoveNotes& notes, const Flat&) {
    if (move.kind != PathMove::Kind::Feed) return ir::kAxes[static_cast<std::size_t>(move.kind) - 1];
    // A move to a point that changes one coordinate only.
    return notes.axis.value_or(ir::Axis::Z);
  }

  Emitted measure(std::size_t step, ir::Axis axis, ir::Coordinate target) {
    ir::Measure made;
    made.feature = ir::Feature::Surface;
    made.axis = axis;
    made.target = std::move(target);
    Emitted out{statementOf(std::move(made), flat_.steps[step].range), kNowhere, false};
    for (const std::size_t back : notes_->returnsOf(step)) {
      const MoveNotes& notes = notes_->of(back);
      if (notes.returns && notes.alwaysIdle && notes.shown.empty() && !notes_->isForced(back))
        out.statement.origin.ranges.push_back(flat_.steps[back].range);
    }
    return out;
  }

  // The contact lies the radius of the ball beyond the target.
  ir::Coordinate contact(ir::Axis axis, const ir::ExpressionPtr& target, int side,
                         const std::optional<Value>& form) {
    const ir::VariableId radius = context_.host("tool_radius");
    std::vector<Term> sum = terms(target);
    addTerm(sum, side < 0, ir::variable(radius, target->range));
    // A variable may hold the radius that cancels.
    if (form && factorOf(Symbol::variable(radius), *form) != count(sum, radius)) {
      if (const ir::ExpressionPtr known = expressionOf(form, target->range))
        return coordinate(axis, known, form);
    }
    return coordinate(axis, sumOf(sum, target->range), form);
  }

  Emitted branch(std::size_t step, ir::ConditionPtr condition, std::size_t target) {
    return {statementOf(ir::Branch{std::move(condition), 0}, flat_.steps[step].range), target, false};
  }

  std::vector<Emitted> shown(std::size_t step, const FlatMove& move, const MoveNotes& notes) {
    const ir::Axis axis = axisOf(move, notes, flat_);
    const ir::ExpressionPtr& target = move.axes[ir::indexOf(axis)];
    const SourceRange range = flat_.steps[step].range;
    std::vector<std::pair<Emitted, ir::ConditionPtr>> ways; // a touch, and when it is none
    for (const auto& [side, touch] : notes.shown) {
      const auto form = touch.forms.size() == 1 ? std::optional(touch.forms.begin()->second) : std::nullopt;
      const ir::ExpressionPtr way = expressionOf(form, range);
      ir::ConditionPtr not_;
      if (way) {
        not_ = ir::compare(side > 0 ? ir::Relation::LessEqual : ir::Relation::GreaterEqual, way,
                           ir::constant(0, range, "0"), range);
      }
      if (not_ && !excluded(notes, side, *form)) not_ = nullptr;
      ways.push_back(
          {measure(step, axis, contact(axis, target, side, touch.contact.value)), std::move(not_)});
    }
    const bool always = notes.others.empty() && !notes.shown.begin()->second.mayBeNone;
    if (ways.size() == 1 && always) return {std::move(ways.front().first)};
    const bool apart =
        std::all_of(ways.begin(), ways.end(), [](const auto& way) { return way.second != nullptr; });
    if (!apart) {
      notShown(step, "on some paths the move goes back along the same axis");
      return {};
    }
    std::vector<Emitted> out;
    const std::size_t next = step + 1;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const bool last = i + 1 == ways.size() && !notes.moves;
      out.push_back(branch(step, ways[i].second, last ? next : markOf(step, i)));
      out.push_back(std::move(ways[i].first));
      if (last) continue;
      out.push_back({statementOf(ir::Jump{}, range), next, false});
      out.push_back({{}, markOf(step, i), true});
    }
    if (notes.moves) out.push_back(plain(step, move, notes));
    return out;
  }

  // On no other way the contact lies on this side.
  static bool excluded(const MoveNotes& notes, int side, const Value& form) {
    const auto otherSide = [&](const Facts& facts) {
      const auto mirrored = linear(form, side, 0.0, 0); // above 0 on this side
      return mirrored && provenNotAbove(facts, *mirrored);
    };
    if (!std::all_of(notes.others.begin(), notes.others.end(), otherSide)) return false;
    for (const auto& [other, touch] : notes.shown)
      if (other != side && !std::all_of(touch.facts.begin(), touch.facts.end(), otherSide)) return false;
    return true;
  }

  std::size_t markOf(std::size_t step, std::size_t number) const {
    return flat_.steps.size() + 1 + 2 * step + number;
  }

  std::vector<Emitted> forced(std::size_t step, const FlatMove& move, const MoveNotes& notes) {
    const SourceRange range = flat_.steps[step].range;
    if (!notes.oneAxis) {
      refuse<diag::CannotTranslate>(range, "this is named as a touch, but moves along more than one axis");
      return {};
    }
    const ir::Axis axis = axisOf(move, notes, flat_);
    const std::size_t at = ir::indexOf(axis);
    const ir::ExpressionPtr& target = move.axes[at];
    if (axis == ir::Axis::Z) return {measure(step, axis, coordinate(axis, target, notes.target[at].value))};
    const auto form = [&](int side) -> std::optional<Value> {
      const Value radius = sourceValue(Symbol::variable(context_.host("tool_radius")));
      if (!notes.target[at].value) return std::nullopt;
      return linear(*notes.target[at].value, 1, radius, side);
    };
    const Emitted up = measure(step, axis, contact(axis, target, 1, form(1)));
    const Emitted down = measure(step, axis, contact(axis, target, -1, form(-1)));
    if (notes.above) return {up};
    if (notes.below) return {down};
    const ir::ExpressionPtr begin = expressionOf(notes.begin.value, range);
    if (!begin) {
      refuse<diag::CannotTranslate>(range, "which way this touch goes is not known");
      return {};
    }
    return {branch(step, ir::compare(ir::Relation::LessEqual, target, begin, range), markOf(step, 0)),
            up,
            {statementOf(ir::Jump{}, range), step + 1, false},
            {{}, markOf(step, 0), true},
            branch(step, ir::compare(ir::Relation::GreaterEqual, target, begin, range), step + 1),
            down};
  }

  void reportFields() {
    std::set<ir::VariableId> used;
    for (const ir::CycleStatement& each : cycle_.body) {
      match(
          each, [&](const ir::Assign& node) { collectVariables(node.value, used); },
          [&](const ir::Branch& node) { collectVariables(node.condition, used); },
          [&](const ir::Measure& node) { collectVariables(node.target->value, used); },
          [&](const ir::Move& node) {
            for (const auto& axis : node.axes)
              if (axis) collectVariables(axis->value, used);
          },
          // What no path has, or what holds no field.
          [](const ir::OneOf<ir::Label, ir::Jump, ir::Store, ir::ProbePower, ir::Comment, ir::Return,
                             ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                             ir::CallCycle, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {});
    }
    std::vector<std::string> names;
    for (ir::VariableId id = 0; id < cycle_.variables.size(); ++id)
      if (cycle_.variables[id].role == ir::Role::Parameter && !used.contains(id))
        names.push_back("`" + cycle_.variables[id].name + "`");
    if (names.empty()) return;
    std::string text = names.front();
    for (std::size_t i = 1; i < names.size(); ++i)
      text += (i + 1 == names.size() ? " and " : ", ") + names[i];
    context_.diagnostics.report<diag::FieldsWithoutMove>({macro_.file, 0, 0}, text);
  }

  const Macro& macro_;
  ir::Cycle& cycle_;
  LowerContext& context_;
  Flat flat_;
  std::set<std::size_t> forced_;
  std::set<ir::VariableId> assigned_;
  WalkOptions options_;
  WalkResult walk_;
  const TouchNotes* notes_ = nullptr;
  bool ok_ = true;
};

} // namespace

bool lowerToolPath(const Macro& toolPath, ir::Cycle& cycle, LowerContext& context) {
  return PathLowering(toolPath, cycle, context).run();
}

} // namespace dotek::frontend::gibbs
