// Which variable holds what a macro measured, and keeping it where a later call would overwrite it.
#include "backends/common/MacroCall.h"
#include "backends/common/Waits.h"
#include "backends/fanuc/OwnCycles.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Flow.h"
#include "ir/Walk.h"
#include "support/messages/Cycle.h"
#include "support/messages/Fanuc.h"

#include <algorithm>

namespace dotek::backends::fanuc {

bool callsMacro(const State& state, const ir::CycleStatement& statement) {
  return match(
      statement, [](const ir::Move& node) { return node.motion == ir::Motion::Protected; },
      [&](const ir::ProbePower& node) {
        return state.macros.find(node.on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff) != nullptr;
      },
      [](const ir::OneOf<ir::Measure, ir::CallCycle> auto&) { return true; },
      [&](const ir::OpaqueBlock& node) { return !isWait(node, state.control); },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::Assign, ir::Return,
                         ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm, ir::Port,
                         ir::Print> auto&) { return false; });
}

namespace {

// Beyond this, every result is kept.
constexpr std::size_t kMostStatements = 2000;

// The variable that every signature of the set names for the result; nothing where they differ.
std::optional<std::uint32_t> common(const stdlib::MacroSet& macros, ir::ResultName name) {
  std::optional<std::uint32_t> out;
  for (const stdlib::MacroSignature& signature : macros.signatures) {
    const auto* result = findResult(signature, name);
    if (result == nullptr) continue;
    if (out && *out != result->variable) return std::nullopt;
    out = result->variable;
  }
  return out;
}

// Between which statements of a cycle macros are called.
class Between {
public:
  explicit Between(const State& state) : state_(state), next_(ir::successors(state.cycle.body)) {
    next_.emplace_back(); // of the end
    before_.resize(next_.size());
    for (std::size_t i = 0; i < next_.size(); ++i)
      for (const std::size_t to : next_[i])
        before_[to].push_back(i);
  }

  // Whether a macro may be called after the measurement and before the use. Through the measurement itself
  // the result is another one.
  bool overwritten(std::size_t measure, std::size_t use) const {
    const std::size_t size = state_.cycle.body.size();
    if (size > kMostStatements) return true;
    const std::vector<bool> after = around(next_, measure, measure), until = around(before_, use, measure);
    for (std::size_t i = 0; i < size; ++i)
      if (i != measure && i != use && after[i] && until[i] && callsMacro(state_, state_.cycle.body[i]))
        return true;
    return false;
  }

  // The measurements that are the last one on some way to the use; none where there is a way without one, or
  // a copied block may have changed what they leave.
  std::vector<const ir::CycleStatement*> lastOnWays(std::size_t use) const {
    std::vector<const ir::CycleStatement*> out;
    std::vector<bool> seen(before_.size());
    std::vector<std::size_t> open = {use};
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      if (at == 0) return {};
      for (const std::size_t from : before_[at]) {
        if (seen[from]) continue;
        seen[from] = true;
        const ir::CycleStatement& statement = state_.cycle.body[from];
        switch (leavesOf(statement, state_.control)) {
        case Leaves::Results: out.push_back(&statement); break;
        case Leaves::Unknown: return {};
        case Leaves::Them: open.push_back(from); break;
        }
      }
    }
    return out;
  }

private:
  using Ways = std::vector<std::vector<std::size_t>>;
  // What a statement does to the results that it finds: results of its own, what nobody knows, nothing.
  enum class Leaves : std::uint8_t { Results, Unknown, Them };

  static Leaves leavesOf(const ir::CycleStatement& statement, const stdlib::Control& control) {
    return match(
        statement, [](const ir::Measure&) { return Leaves::Results; },
        [](const ir::CallCycle& node) { return node.power ? Leaves::Them : Leaves::Results; },
        [&](const ir::OpaqueBlock& node) { return isWait(node, control) ? Leaves::Them : Leaves::Unknown; },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Move, ir::ProbePower, ir::Comment,
                           ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop,
                           ir::Alarm, ir::Port, ir::Print> auto&) { return Leaves::Them; });
  }

  // What is reached from a statement, on no way through `without`.
  static std::vector<bool> around(const Ways& ways, std::size_t from, std::size_t without) {
    std::vector<bool> out(ways.size());
    std::vector<std::size_t> open = {from};
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for (const std::size_t to : ways[at]) {
        if (to == without || out[to]) continue;
        out[to] = true;
        open.push_back(to);
      }
    }
    return out;
  }

  const State& state_;
  Ways next_, before_;
};

// What an error is the error of, where it has an axis that one.
struct ErrorOf {
  ir::ResultName measured;
  std::optional<ir::Axis> axis;
};
std::optional<ErrorOf> errorOf(ir::ResultName name) {
  switch (name) {
  case ir::ResultName::ErrorX: return ErrorOf{ir::ResultName::PositionX, ir::Axis::X};
  case ir::ResultName::ErrorY: return ErrorOf{ir::ResultName::PositionY, ir::Axis::Y};
  case ir::ResultName::ErrorZ: return ErrorOf{ir::ResultName::PositionZ, ir::Axis::Z};
  case ir::ResultName::SizeError: return ErrorOf{ir::ResultName::Size, std::nullopt};
  default: return std::nullopt;
  }
}

// The macro leaves what was measured, and not its error.
bool isComputed(const State& state, const ir::CycleStatement& measured, ir::ResultName name) {
  if (isOwnTouchAlong(measured)) return name == ir::ResultName::Main || name == ir::ResultName::PositionZ;
  const auto of = errorOf(name);
  const stdlib::MacroSignature* signature = of ? signatureOf(state.macros, measured) : nullptr;
  if (signature == nullptr || findResult(*signature, name) != nullptr) return false;
  const stdlib::MacroResult* found = findResult(*signature, of->measured);
  return found != nullptr && found->documented;
}

// What the source expects there, as the statement that is being written has it; nullptr: not known.
ir::ExpressionPtr expectedOf(State& state, const ir::CycleStatement& measured, std::optional<ir::Axis> axis) {
  if (const auto* measure = std::get_if<ir::Measure>(&measured.node)) {
    if (!axis) return measure->diameter;
    return measure->target ? place(state, *measure->target, *axis, ir::Frame::Work, measured.origin.range())
                           : workPosition(state, *axis);
  }
  const auto* cycle = std::get_if<ir::CallCycle>(&measured.node);
  if (cycle == nullptr) return nullptr;
  for (const ir::CycleArgument& one : cycle->arguments) {
    if (!axis && (one.parameter == stdlib::roleName(stdlib::ArgumentRole::Diameter) ||
                  one.parameter.starts_with(stdlib::roleName(stdlib::ArgumentRole::Width))))
      return one.value;
    if (axis && one.frame && one.parameter.back() == "xyz"[ir::indexOf(*axis)])
      return place(state, {one.value, *one.frame, nullptr}, *axis, ir::Frame::Work, measured.origin.range());
  }
  return axis ? awayFrom(workPosition(state, *axis), *cycle, *axis) : nullptr;
}

bool expectsAtPosition(State& state, const ir::CycleStatement& measured, ir::Axis axis) {
  if (const auto* measure = std::get_if<ir::Measure>(&measured.node))
    return !measure->target && workPosition(state, axis) == nullptr;
  const auto* cycle = std::get_if<ir::CallCycle>(&measured.node);
  return cycle != nullptr && isAtPosition(state, *cycle, axis);
}

// Each of the measurements keeps the result in one local, where they leave it in several variables.
void planMerged(State& state, Body& body, const Between& between, std::size_t at,
                const std::set<ir::ResultName>& names) {
  if (state.cycle.body.size() > kMostStatements) return;
  const std::vector<const ir::CycleStatement*> measured = between.lastOnWays(at);
  for (const ir::ResultName name : names) {
    if (common(state.macros, name)) continue;
    std::set<std::uint32_t> locals;
    bool known = !measured.empty();
    for (const ir::CycleStatement* one : measured) {
      const auto* signature = signatureOf(state.macros, *one);
      known = known && signature != nullptr &&
              (isComputed(state, *one, name) || resultAfter(*signature, *one, name).result != nullptr);
      if (const auto kept = body.kept.find({one, name}); kept != body.kept.end()) locals.insert(kept->second);
    }
    if (!known || locals.size() > 1) continue; // reported where it is read
    const std::uint32_t local = locals.empty() ? state.pool.take() : *locals.begin();
    if (local == 0)
      state.refuse<diag::TooManyLocals>(state.cycle.body[at].origin.range(), ir::resultTitle(name),
                                        state.control.locals);
    for (const ir::CycleStatement* one : measured)
      body.kept[{one, name}] = local;
    body.merged[{at, name}] = local;
  }
}

} // namespace

void planResults(State& state, Body& body) {
  const auto& list = state.cycle.body;
  const Between between(state);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const ir::CycleStatement* last = body.last[i];
    std::set<ir::ResultName> names;
    ir::eachNode(list[i], [&](const ir::Expression& node) {
      if (const auto* result = std::get_if<ir::MeasuredResult>(&node.node)) names.insert(result->name);
    });
    if (names.empty()) continue;
    if (last == nullptr) {
      planMerged(state, body, between, i, names);
      continue;
    }
    const bool lost = between.overwritten(static_cast<std::size_t>(last - list.data()), i);
    for (const ir::ResultName name : names) {
      if (!lost && !isComputed(state, *last, name)) continue;
      if (body.kept.contains({last, name})) continue;
      const std::uint32_t local = state.pool.take();
      if (local == 0)
        state.refuse<diag::TooManyLocals>(list[i].origin.range(), ir::resultTitle(name),
                                          state.control.locals);
      body.kept[{last, name}] = local;
    }
  }
}

namespace {

// The macro's own variable for a result of the measurement; nothing where it was refused.
std::optional<std::uint32_t> variableOf(State& state, ir::ResultName name, const ir::CycleStatement* measure,
                                        SourceRange range) {
  if (measure == nullptr) {
    if (const auto shared = common(state.macros, name)) return shared;
  } else if (const auto* signature = signatureOf(state.macros, *measure)) {
    const FoundResult found = resultAfter(*signature, *measure, name);
    if (found.instead)
      state.diagnostics.report<diag::ResultDiffers>(range, found.result->variable, state.macros.title,
                                                    ir::resultTitle(*found.instead));
    if (found.result != nullptr) return found.result->variable;
  }
  // Of a measurement that was refused nothing more is said.
  const bool refused = measure != nullptr && state.failed && signatureOf(state.macros, *measure) == nullptr;
  if (!refused) state.refuse<diag::ResultUnknown>(range, state.macros.title, ir::resultTitle(name));
  return std::nullopt;
}

} // namespace

void keepPositions(State& state, const ir::Origin& given) {
  const ir::CycleStatement* measure = &state.cycle.body[state.at];
  for (const auto& [key, local] : state.body->kept) {
    const std::optional<ErrorOf> of = key.first == measure ? errorOf(key.second) : std::nullopt;
    if (!of || !of->axis || !isComputed(state, *measure, key.second)) continue;
    if (!expectsAtPosition(state, *measure, *of->axis)) continue;
    ir::Origin origin;
    origin.ranges = given.ranges;
    origin.reason = "where the feature is expected";
    ir::ExpressionPtr now = positionNow(state, *of->axis, origin);
    if (const auto* cycle = std::get_if<ir::CallCycle>(&measure->node))
      now = awayFrom(now, *cycle, *of->axis);
    if (now == nullptr) continue; // refused where its error is computed
    assign(state, "#" + std::to_string(local), now, origin);
    state.waited = state.sheet.size(); // nothing moves in between
    state.expectedRead.insert(key);
  }
}

void keepResults(State& state, const ir::Origin& given) {
  const ir::CycleStatement* measure = &state.cycle.body[state.at];
  for (const auto& [key, local] : state.body->kept) {
    if (key.first != measure) continue;
    ir::Origin origin;
    origin.ranges = given.ranges;
    if (isComputed(state, *measure, key.second)) {
      origin.reason = "measured minus expected";
      if (isOwnTouchAlong(*measure)) {
        const ir::ExpressionPtr value = resultAlong(state, *measure, key.second);
        if (value == nullptr && key.second == ir::ResultName::PositionZ)
          state.refuse<diag::CycleStatementCannot>(origin.range(), "the height of a touch along a direction",
                                                   state.control.title, state.macros.title,
                                                   "write `here.z + ball_radius` in its place");
        else if (value == nullptr)
          state.refuse<diag::ResultUnknown>(origin.range(), state.macros.title, ir::resultTitle(key.second));
        else
          assign(state, "#" + std::to_string(local), value, origin);
        continue;
      }
      const ErrorOf of = *errorOf(key.second);
      const ir::ExpressionPtr expected = state.expectedRead.contains(key)
                                             ? systemVariable(static_cast<int>(local))
                                             : expectedOf(state, *measure, of.axis);
      const auto variable = variableOf(state, of.measured, measure, origin.range());
      if (expected == nullptr)
        state.refuse<diag::ResultUnknown>(origin.range(), state.macros.title, ir::resultTitle(key.second));
      else if (variable)
        assign(state, "#" + std::to_string(local),
               ir::binary(ir::BinaryOp::Subtract, systemVariable(static_cast<int>(*variable)), expected),
               origin);
      continue;
    }
    origin.reason = "kept before the next call overwrites it";
    if (const auto variable = variableOf(state, key.second, measure, origin.range()))
      state.sheet.add("#" + std::to_string(local) + "=#" + std::to_string(*variable), origin);
  }
}

std::string resultText(State& state, ir::ResultName name, SourceRange range) {
  const ir::CycleStatement* measure = state.body == nullptr ? nullptr : state.body->last[state.at];
  if (measure != nullptr)
    if (const auto kept = state.body->kept.find({measure, name}); kept != state.body->kept.end())
      return "#" + std::to_string(kept->second);
  if (measure == nullptr && state.body != nullptr)
    if (const auto merged = state.body->merged.find({state.at, name}); merged != state.body->merged.end())
      return "#" + std::to_string(merged->second);
  if (state.body == nullptr) {
    state.refuse<diag::ResultUnknown>(range, state.macros.title, ir::resultTitle(name));
    return "#0";
  }
  const auto variable = variableOf(state, name, measure, range);
  return variable ? "#" + std::to_string(*variable) : "#0";
}

} // namespace dotek::backends::fanuc
