#include "frontend/gibbs/LowerWalk.h"

#include "frontend/gibbs/LowerTerms.h"

#include <algorithm>

namespace dotek::frontend::gibbs {
namespace {

constexpr std::size_t kMaxSteps = 300'000;
constexpr std::size_t kStatesAPath = 64;    // states that may be kept for each path that the limit allows
constexpr std::size_t kMaxLive = 1'000'000; // words of 64 places and variables
constexpr std::size_t kWiden = 64;          // states at one place before changing variables count as unknown
constexpr std::uint32_t kPart = 1u << 31;   // in keys: a part of all numbers, no number of a value

} // namespace

std::vector<std::size_t> followers(const Flat& flat, std::size_t at) {
  const auto& step = flat.steps[at].step;
  if (std::holds_alternative<FlatEnd>(step) || std::holds_alternative<FlatReturn>(step) ||
      std::holds_alternative<FlatRefuse>(step))
    return {};
  if (const auto* jump = std::get_if<FlatJump>(&step)) return {jump->target};
  if (const auto* branch = std::get_if<FlatBranch>(&step)) return {at + 1, branch->target};
  return {at + 1};
}

Circles::Circles(const Flat& flat) : of_(flat.steps.size(), kNone) {
  // Tarjan's strongly connected components, without recursion: a step and all that it can come back from.
  const std::size_t size = flat.steps.size();
  std::vector<std::size_t> order(size, kNone), low(size);
  std::vector<std::size_t> found; // not yet of a circle
  struct Frame {
    std::size_t at;
    std::vector<std::size_t> next;
  };
  std::vector<Frame> open;
  std::size_t count = 0;
  const auto enter = [&](std::size_t at) {
    order[at] = low[at] = count++;
    found.push_back(at);
    open.push_back({at, followers(flat, at)});
  };
  for (std::size_t root = 0; root < size; ++root) {
    if (order[root] != kNone) continue;
    for (enter(root); !open.empty();) {
      Frame& frame = open.back();
      const std::size_t at = frame.at;
      if (!frame.next.empty()) {
        const std::size_t next = frame.next.back();
        frame.next.pop_back();
        if (next >= size) continue;
        if (order[next] == kNone)
          enter(next);
        else if (of_[next] == kNone)
          low[at] = std::min(low[at], order[next]);
        continue;
      }
      open.pop_back();
      if (!open.empty()) low[open.back().at] = std::min(low[open.back().at], low[at]);
      if (low[at] == order[at]) close(flat, at, found);
    }
  }
}

// Takes the steps of one circle off `found`, down to `head`.
void Circles::close(const Flat& flat, std::size_t head, std::vector<std::size_t>& found) {
  CycleChanges changes;
  const bool alone = found.back() == head; // no step that changes anything leads to itself
  for (std::size_t at = kNone; at != head;) {
    at = found.back();
    found.pop_back();
    of_[at] = changes_.size();
    if (alone) continue;
    if (const auto* assign = std::get_if<FlatAssign>(&flat.steps[at].step))
      changes.variables.insert(assign->variable);
    if (const auto* unset = std::get_if<FlatUnset>(&flat.steps[at].step))
      changes.variables.insert(unset->variable);
    const auto* move = std::get_if<FlatMove>(&flat.steps[at].step);
    for (std::size_t axis = 0; move != nullptr && axis < 3; ++axis)
      changes.axes[axis] = changes.axes[axis] || move->axes[axis] != nullptr;
  }
  changes_.push_back(std::move(changes));
}

Walk::Walk(const Flat& flat, const ir::Cycle& cycle, const Limits& limits, WalkOptions options)
    : flat_(flat), cycle_(cycle), options_(std::move(options)),
      maxStates_(std::size_t{std::min(limits.paths, 1u << 16)} * kStatesAPath),
      maxSteps_(std::min<std::size_t>(limits.steps, kMaxSteps)) {}

WalkResult Walk::run() {
  start();
  result_.complete = true;
  while (!waiting_.empty()) {
    WalkState state = std::move(waiting_.back());
    waiting_.pop_back();
    follow(std::move(state));
    if (steps_ <= maxSteps_ && states_ + waiting_.size() <= maxStates_) continue;
    result_.complete = false;
    break;
  }
  finish();
  return std::move(result_);
}

void Walk::finish() {
  cases_.forPassed(flat_, [&](std::size_t step, bool jumps) {
    result_.reached[step] = true;
    if (std::holds_alternative<FlatBranch>(flat_.steps[step].step))
      (jumps ? result_.jumps : result_.falls)[step] = true;
  });
  if (!result_.complete) return;
  ways_.endsBehind(result_.behind);
  ways_.codesOf(result_.codes);
}

void Walk::start() {
  const std::size_t size = flat_.steps.size();
  result_.reached.assign(size, false);
  result_.jumps.assign(size, false);
  result_.falls.assign(size, false);
  joins_.assign(size, false);
  seen_.resize(size);
  heads_.assign(size, false);
  for (std::size_t at = 0; at < size; ++at) {
    const auto* jump = std::get_if<FlatJump>(&flat_.steps[at].step);
    const auto* branch = std::get_if<FlatBranch>(&flat_.steps[at].step);
    if (jump == nullptr && branch == nullptr) continue;
    const std::size_t target = jump != nullptr ? jump->target : branch->target;
    joins_[target] = true;
    if (target <= at) heads_[target] = true;
  }
  constant_.assign(cycle_.variables.size(), true);
  for (const FlatStep& each : flat_.steps) {
    if (const auto* assign = std::get_if<FlatAssign>(&each.step)) constant_[assign->variable] = false;
    if (const auto* unset = std::get_if<FlatUnset>(&each.step)) constant_[unset->variable] = false;
  }
  WalkState first;
  constants_.resize(cycle_.variables.size());
  slots_.resize(cycle_.variables.size());
  for (ir::VariableId id = 0; id < cycle_.variables.size(); ++id) {
    const bool local = cycle_.variables[id].role == ir::Role::Local;
    constant_[id] = constant_[id] && !local;
    const auto known = options_.values.find(id);
    std::optional<Value> value;
    if (!local)
      value = known != options_.values.end() ? Value(known->second) : sourceValue(Symbol::variable(id));
    if (constant_[id]) {
      constants_[id] = std::move(value);
      continue;
    }
    slots_[id] = changing_.size();
    changing_.push_back(id);
    first.values.push_back(std::move(value));
  }
  computeLiveness();
  if (options_.observer == nullptr && options_.forget) findAsked();
  first.track.at = {Value(0.0), Value(0.0), std::nullopt};
  first.way = ways_.first();
  if (size > 0) waiting_.push_back(std::move(first));
}

void Walk::findAsked() {
  const auto questionOf = [&](const ir::Comparison& comparison) -> std::optional<Question> {
    std::set<ir::VariableId> read;
    collectVariables(comparison.left, read);
    collectVariables(comparison.right, read);
    if (!std::all_of(read.begin(), read.end(), [&](ir::VariableId id) { return constant_[id]; }))
      return std::nullopt;
    WalkState none;
    question_.reset();
    failed_ = false;
    decide(none, comparison);
    return failed_ ? std::nullopt : question_;
  };
  asked_.emplace(flat_, constant_, questionOf);
  cases_ = Cases(flat_, heads_);
}

void Walk::computeLiveness() {
  const std::size_t size = flat_.steps.size();
  liveWords_ = (cycle_.variables.size() + 63) / 64;
  if (!options_.forget || size * liveWords_ > kMaxLive) return;
  std::vector<std::set<ir::VariableId>> reads(size);
  std::vector<ir::VariableId> writes(size, kNoVariable);
  for (std::size_t at = 0; at < size; ++at) {
    const auto& step = flat_.steps[at].step;
    if (const auto* assign = std::get_if<FlatAssign>(&step)) {
      writes[at] = assign->variable;
      collectVariables(assign->value, reads[at]);
    }
    if (const auto* unset = std::get_if<FlatUnset>(&step)) writes[at] = unset->variable;
    if (const auto* branch = std::get_if<FlatBranch>(&step)) collectVariables(branch->condition, reads[at]);
    if (const auto* end = std::get_if<FlatReturn>(&step)) reads[at].insert(end->code);
    if (const auto* move = std::get_if<FlatMove>(&step)) {
      for (const ir::ExpressionPtr& axis : move->axes)
        collectVariables(axis, reads[at]);
    }
  }
  live_.assign(size * liveWords_, 0);
  std::vector<std::uint64_t> now(liveWords_);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t at = size; at-- > 0;) {
      std::fill(now.begin(), now.end(), 0);
      for (const std::size_t next : followers(flat_, at)) {
        for (std::size_t i = 0; next < size && i < liveWords_; ++i)
          now[i] |= live_[next * liveWords_ + i];
      }
      if (writes[at] != kNoVariable) now[writes[at] / 64] &= ~(std::uint64_t{1} << writes[at] % 64);
      for (const ir::VariableId id : reads[at])
        now[id / 64] |= std::uint64_t{1} << id % 64;
      const auto known = live_.begin() + static_cast<std::ptrdiff_t>(at * liveWords_);
      if (std::equal(now.begin(), now.end(), known)) continue;
      std::copy(now.begin(), now.end(), known);
      changed = true;
    }
  }
}

// ---- states ---------------------------------------------------------------------------------------------

void Walk::follow(WalkState state) {
  for (;;) {
    if (++steps_ > maxSteps_) return;
    if (joins_[state.at] && !state.answered && !isNew(state)) return;
    state.answered = false;
    if (const auto variable = cases_.variableAt(state.at)) {
      const std::optional<double> number = knownNumber(state, *variable);
      const std::size_t next = number ? cases_.next(state.at, *number) : state.at;
      if (next != state.at) {
        state.at = next;
        continue;
      }
    }
    result_.reached[state.at] = true;
    if (!step(state)) return;
  }
}

// The value, or the one that conditions have left of all.
std::optional<double> Walk::knownNumber(WalkState& state, ir::VariableId variable) {
  const std::optional<Value>& value = valueOf(state, variable);
  if (!value) return std::nullopt;
  if (const double* number = std::get_if<double>(&*value)) return *number;
  if (!constant_[variable] || unknownIn(*value) == nullptr) return std::nullopt;
  std::string& quantity = quantities_[variable];
  if (quantity.empty()) quantity = questionOf(*unknownIn(*value), Relation::Equal, {}).key;
  const auto fact = state.facts.find(quantity);
  if (fact == state.facts.end()) return std::nullopt;
  const Range& range = fact->second.range;
  return range.low() == range.high() ? range.low() : std::nullopt;
}

bool Walk::isNew(WalkState& state) {
  if (heads_[state.at]) {
    Head& head = circles_[state.at];
    if (!circlesOf_) circlesOf_.emplace(flat_);
    if (head.first.empty()) head.changes = circlesOf_->around(state.at);
    compareVisit(head, state);
    if (seen_[state.at].size() >= kWiden) widen(state, head);
  }
  forget(state);
  const auto [known, isNew] = seen_[state.at].try_emplace(keyOf(state), state.way);
  if (!isNew) {
    ways_.join(state.way, known->second);
    return false;
  }
  state.way = known->second = ways_.after(state.way);
  ++states_;
  return true;
}

// Facts that no later condition can ask for: one of their symbols is in no value that is read again.
void Walk::forget(WalkState& state) const {
  if (!options_.forget || state.facts.empty()) return;
  std::vector<const Symbol*> symbols;
  const auto add = [&](const std::optional<Value>& value) {
    const Unknown* unknown = value ? unknownIn(*value) : nullptr;
    if (unknown == nullptr) return;
    for (const Symbol& symbol : unknown->sources)
      symbols.push_back(&symbol);
  };
  for (std::size_t slot = 0; slot < changing_.size(); ++slot)
    if (live(state.at, changing_[slot])) add(state.values[slot]);
  for (const auto& axis : state.track.at)
    add(axis);
  for (const auto* leg : {&state.track.before, &state.track.last}) {
    if (!*leg) continue;
    add((*leg)->begin);
    add((*leg)->target);
  }
  const auto less = [](const Symbol* a, const Symbol* b) { return *a < *b; };
  std::sort(symbols.begin(), symbols.end(), less);
  const auto held = [&](const Symbol& symbol) {
    return std::binary_search(symbols.begin(), symbols.end(), &symbol, less);
  };
  for (auto fact = state.facts.begin(); fact != state.facts.end();) {
    bool keeps = true;
    bool reduces = asked_.has_value();
    for (const Symbol& symbol : fact->second.symbols) {
      const auto id = static_cast<ir::VariableId>(symbol.number);
      const bool isConstant = symbol.kind == Symbol::Kind::Variable && constant_[id];
      const bool isHeld = held(symbol);
      keeps = keeps && (isHeld || (isConstant && live(state.at, id)));
      reduces = reduces && !isHeld && isConstant && !asked_->isReadFrom(id, asked_->from(state.at));
    }
    if (keeps && (reduces || fact->second.reduced)) keeps = reduce(fact->first, fact->second, state.at);
    fact = keeps ? std::next(fact) : state.facts.erase(fact);
  }
}

// Keeps of the fact what later conditions can tell; false: that is nothing.
bool Walk::reduce(const std::string& quantity, Fact& fact, std::size_t at) const {
  const AskedBounds& bounds = asked_->ofQuantity(quantity);
  const std::size_t from = asked_->from(at);
  const std::uint32_t lowest = bounds.lowestOf(fact.range, from);
  const std::uint32_t highest = bounds.highestOf(fact.range, from);
  fact.reduced = true;
  fact.learnt.clear();
  fact.numbers.clear();
  fact.parts = {lowest, highest};
  fact.range.keepExcluded([&](double value) {
    if (!bounds.isAsked(value, from)) return false;
    const std::uint32_t part = bounds.partOf(value, from);
    if (part < lowest || part > highest) return false;
    fact.parts.push_back(part);
    return true;
  });
  return lowest > 0 || highest < bounds.last(from) || fact.parts.size() > 2;
}

std::uint32_t Walk::numberOf(const std::optional<Value>& value) {
  bytes_.clear();
  if (value) appendKey(bytes_, *value);
  return numberOf(bytes_);
}

std::uint32_t Walk::numberOf(const WalkState& state, std::size_t slot) {
  const std::optional<Value>& value = state.values[slot];
  const double* number = value ? std::get_if<double>(&*value) : nullptr;
  if (!asked_ || number == nullptr) return numberOf(value);
  const std::size_t from = asked_->from(state.at);
  const AskedBounds* bounds = asked_->ofVariable(changing_[slot], from);
  return bounds == nullptr ? numberOf(value) : kPart + bounds->partOf(*number, from);
}

std::u32string Walk::keyOf(const WalkState& state) {
  std::u32string key;
  const auto add = [&](std::size_t number) { key += static_cast<char32_t>(number); };
  for (std::size_t slot = 0; slot < changing_.size(); ++slot)
    if (live(state.at, changing_[slot])) add(numberOf(state, slot));
  add(state.facts.size());
  for (const auto& [quantity, fact] : state.facts) {
    add(numberOf(quantity));
    add(fact.parts.size());
    for (const std::uint32_t part : fact.parts)
      add(part);
    if (!fact.reduced) add(fact.numbers.empty() ? 0 : fact.numbers.back());
  }
  if (options_.observer == nullptr) return key;
  for (const auto& axis : state.track.at)
    add(numberOf(axis));
  for (const auto* leg : {&state.track.before, &state.track.last}) {
    add(leg->has_value());
    if (!*leg) continue;
    add((*leg)->step);
    add(static_cast<std::size_t>((*leg)->sign + 1));
    add((*leg)->forced);
    add((*leg)->exempt);
    add(ir::indexOf((*leg)->axis));
    add(numberOf((*leg)->begin));
    add(numberOf((*leg)->target));
  }
  add(state.track.run);
  add(state.track.stood.size());
  for (const std::size_t place : state.track.stood)
    add(place);
  for (const Turn& turn : state.track.turns) {
    add(turn.run);
    add(turn.step);
    add(turn.place);
  }
  return key;
}

// What differs from the first visit of the place.
void Walk::compareVisit(Head& head, const WalkState& state) {
  std::vector<std::uint32_t> now;
  for (const auto& value : state.values)
    now.push_back(numberOf(value));
  for (const auto& value : state.track.at)
    now.push_back(numberOf(value));
  if (head.first.empty()) {
    head.first = std::move(now);
    head.varies.assign(head.first.size(), false);
    return;
  }
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] != head.first[i]) head.varies[i] = true;
}

// The place was visited so often that what changes between two visits counts as unknown.
void Walk::widen(WalkState& state, const Head& head) {
  const auto isOfThisPlace = [at = state.at](const Symbol& symbol) {
    return symbol.kind == Symbol::Kind::Widened && symbol.number == at;
  };
  std::size_t made = 0;
  // An unknown of an earlier visit is not the one of this visit.
  const auto stale = [&](const std::optional<Value>& value) {
    const Unknown* unknown = value ? unknownIn(*value) : nullptr;
    return unknown != nullptr && std::any_of(unknown->sources.begin(), unknown->sources.end(), isOfThisPlace);
  };
  // Parts: the variables, the axes, the legs.
  const auto fresh = [&](std::size_t part) {
    ++made;
    return sourceValue(Symbol::widened(state.at, part));
  };
  const std::size_t axes = state.values.size();
  for (std::size_t slot = 0; slot < changing_.size(); ++slot) {
    if (state.values[slot] && ((head.varies[slot] && head.changes.variables.contains(changing_[slot])) ||
                               stale(state.values[slot])))
      state.values[slot] = fresh(slot);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool varies = head.changes.axes[axis] && head.varies[axes + axis];
    if (state.track.at[axis] && (varies || stale(state.track.at[axis])))
      state.track.at[axis] = fresh(axes + axis);
  }
  std::size_t part = axes + 3;
  for (auto* leg : {&state.track.before, &state.track.last}) {
    ++part;
    if (!*leg) continue;
    const std::size_t axis = ir::indexOf((*leg)->axis);
    const bool varies = head.changes.axes[axis] && head.varies[axes + axis];
    if (!varies && !stale((*leg)->begin) && !stale((*leg)->target)) continue;
    (*leg)->begin.reset();
    (*leg)->target = fresh(part);
  }
  if (made == 0) return;
  std::erase_if(state.facts, [&](const auto& fact) {
    return std::any_of(fact.second.symbols.begin(), fact.second.symbols.end(), isOfThisPlace);
  });
}

// ---- steps ----------------------------------------------------------------------------------------------

bool Walk::step(WalkState& state) {
  return std::visit([&](const auto& s) { return step(state, s); }, flat_.steps[state.at].step);
}

bool Walk::step(WalkState& state, const FlatJump& s) {
  state.at = s.target;
  return true;
}

bool Walk::step(WalkState& state, const FlatEnd& s) {
  if (s.rejects) result_.codes[state.at];
  ended(state, s.rejects);
  return false;
}

bool Walk::step(WalkState&, const FlatRefuse& s) {
  result_.refusals.push_back(s.diagnostic);
  return false;
}

bool Walk::step(WalkState& state, const FlatMessage&) {
  result_.behind[state.at];
  if (options_.alarms.contains(state.at)) return false;
  ways_.shows(state.way, state.at++);
  return true;
}

// What was shown before the dialog does not reject what is typed into it.
bool Walk::step(WalkState& state, const FlatDialog&) {
  state.way = ways_.afterDialog(state.way);
  ++state.at;
  return true;
}

bool Walk::step(WalkState& state, const FlatUnset& s) {
  valueOf(state, s.variable).reset();
  ++state.at;
  return true;
}

bool Walk::step(WalkState& state, const FlatAssign& s) {
  auto value = evaluate(state, s.value);
  if (!value) return false;
  if (s.variable == flat_.returnCode) ways_.setsCode(state.way, state.at);
  valueOf(state, s.variable) = std::move(*value);
  ++state.at;
  return true;
}

bool Walk::step(WalkState& state, const FlatBranch& s) {
  const std::size_t here = state.at;
  const auto truth = decide(state, s.condition);
  if (!truth) {
    if (failed_) return false;
    WalkState other = state;
    other.way = ways_.after(state.way);
    state.way = ways_.after(state.way);
    learn(other, *question_, opposite(question_->relation));
    learn(state, *question_, question_->relation);
    ++states_;
    state.answered = other.answered = options_.facts;
    if (!options_.facts) {
      // Nothing is learnt, so the question would come again.
      result_.jumps[here] = result_.falls[here] = true;
      state.at = s.target;
      ++other.at;
    }
    waiting_.push_back(std::move(other));
    return true;
  }
  (*truth ? result_.jumps : result_.falls)[here] = true;
  state.at = *truth ? s.target : here + 1;
  return true;
}

bool Walk::step(WalkState& state, const FlatMove& s) {
  std::array<std::optional<Value>, 3> targets;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!s.axes[axis]) continue;
    targets[axis] = evaluate(state, s.axes[axis]);
    if (!targets[axis]) return false;
  }
  if (options_.observer != nullptr) options_.observer->move(state, state.at, targets);
  ++state.at;
  return true;
}

bool Walk::step(WalkState& state, const FlatReturn& s) {
  const std::optional<Value> code = valueOf(state, s.code);
  std::optional<bool> rejects = false;
  if (code) {
    rejects = compare(state, *code, Relation::NotEqual, 0.0);
  } else {
    result_.unset.insert(s.code);
  }
  for (const bool way : {false, true}) {
    if (rejects && *rejects != way) continue;
    (way ? result_.ends[state.at].rejects : result_.ends[state.at].passes) = true;
    if (way) ways_.rejectsByCode(state.way, state.at);
    ended(state, way);
  }
  return false;
}

void Walk::ended(const WalkState& state, bool rejects) {
  ways_.ends(state.way, rejects);
  if (options_.observer == nullptr) return;
  WalkState last = state;
  options_.observer->end(last);
}

} // namespace dotek::frontend::gibbs
