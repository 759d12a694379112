#include "frontend/gibbs/LowerTouch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotek::frontend::gibbs {
namespace {

constexpr std::size_t kMaxWays = 256;  // facts that are kept for one move
constexpr std::size_t kMaxPlaces = 32; // places that are kept for one path

// a - b; nothing where one is not known or the difference is no short form.
std::optional<Value> difference(const std::optional<Value>& a, const std::optional<Value>& b) {
  if (!a || !b) return std::nullopt;
  return linear(*a, 1, *b, -1);
}

bool isZero(const Facts& facts, const std::optional<Value>& value) {
  return value && provenZero(facts, *value);
}

// Axes that the move changes, or may change.
std::vector<ir::Axis> changedAxes(const WalkState& state, const std::array<std::optional<Value>, 3>& target) {
  std::vector<ir::Axis> changed;
  for (const ir::Axis axis : ir::kAxes) {
    const std::size_t at = ir::indexOf(axis);
    if (target[at] && !isZero(state.facts, difference(target[at], state.track.at[at])))
      changed.push_back(axis);
  }
  return changed;
}

// The axis of FEED_X, FEED_Y, FEED_Z by its index; kNowhere: the move is written with all.
std::size_t writtenAxis(const FlatMove& move) {
  return move.kind == PathMove::Kind::Feed ? kNowhere : static_cast<std::size_t>(move.kind) - 1;
}

// The axis that the move goes along; kNowhere: none, or several.
std::size_t axisOf(std::size_t written, const std::vector<ir::Axis>& changed) {
  if (written != kNowhere) return written;
  return changed.size() == 1 ? ir::indexOf(changed.front()) : kNowhere;
}

void keep(std::vector<Facts>& list, const Facts& facts) {
  if (list.size() < kMaxWays)
    list.push_back(facts);
  else
    list.back().clear(); // nothing is known of the paths that are not kept
}

} // namespace

void Seen::add(const std::optional<Value>& next) {
  if (any_ && (!value || !next || canonical(*value) != canonical(*next))) {
    varies = true;
    value.reset();
  }
  if (!any_) value = next;
  any_ = true;
}

const MoveNotes& TouchNotes::of(std::size_t step) const {
  static const MoveNotes kNone;
  const auto found = notes_.find(step);
  return found == notes_.end() ? kNone : found->second;
}

std::set<std::size_t> TouchNotes::returnsOf(std::size_t touch) const {
  const auto found = returns_.find(touch);
  return found == returns_.end() ? std::set<std::size_t>{} : found->second;
}

std::set<std::size_t> TouchNotes::oneSided() const {
  std::set<std::size_t> out;
  for (const auto& [step, notes] : notes_) {
    for (const auto& [side, touch] : notes.shown) {
      if (!touch.mayBeNone) continue;
      const auto answered = [&, other = -side](const std::string& form) {
        return std::any_of(notes_.begin(), notes_.end(), [&](const auto& each) {
          const auto found = each.second.shown.find(other);
          return found != each.second.shown.end() && found->second.forms.contains(form);
        });
      };
      for (const auto& [form, value] : touch.forms)
        if (!answered(form)) out.insert(step);
    }
  }
  return out;
}

std::map<std::size_t, std::set<std::size_t>> TouchNotes::candidates() const {
  std::map<std::size_t, std::set<std::size_t>> out;
  for (const auto& [run, steps] : candidates_) {
    for (const std::size_t step : steps)
      if (!approaches_.contains(step) && !withoutReturn_.contains(step)) out[run].insert(step);
  }
  return out;
}

// A height, wherever it is over X and Y; along X and Y a point. kNowhere: not known.
std::size_t TouchNotes::placeOf(const Track& track, std::size_t axis, const Value& target) {
  std::string text = fmt::format("{}", axis);
  for (std::size_t i = 0; i < 3; ++i) {
    if (axis == ir::indexOf(ir::Axis::Z) && i != axis) continue;
    const std::optional<Value> at = i == axis ? std::optional(target) : track.at[i];
    if (!at || isWidened(*at)) return kNowhere;
    text += ";" + canonical(*at);
  }
  return placeNumbers_.emplace(text, placeNumbers_.size()).first->second;
}

// The path is at track.at: it does not turn back here, it goes on along another axis or ends.
void TouchNotes::stand(Track& track) {
  for (std::size_t axis = 0; places_ && axis < 3; ++axis) {
    if (!track.at[axis]) continue;
    const std::size_t place = placeOf(track, axis, *track.at[axis]);
    if (place == kNowhere) continue;
    std::erase_if(track.turns, [&](const Turn& turn) { return turn.place == place; });
    if (track.stood.size() < kMaxPlaces) track.stood.insert(place);
  }
}

// The path went back after `leg`. No touch goes to where the path has stood before, nor to a height at which
// it is later: there it would appear in the material. None along Z goes up.
void TouchNotes::turn(Track& track, const Leg& leg, bool rises) {
  const std::size_t axis = ir::indexOf(leg.axis);
  const std::size_t place = placeOf(track, axis, leg.target);
  if (place != kNowhere && track.stood.contains(place)) return;
  if (rises) return;
  if (places_ && place != kNowhere && leg.axis == ir::Axis::Z && track.turns.size() < kMaxPlaces)
    track.turns.insert({track.run, leg.step, place});
  else
    candidates_[track.run].insert(leg.step);
}

// What the move before the one at `step` was, now that its follower is known. `next`: where the follower goes
// along the same axis; nothing: elsewhere. `consumed`: the follower is the path back from a touch.
void TouchNotes::judge(WalkState& state, const std::optional<Value>& next, std::size_t step, bool& consumed) {
  Track& track = state.track;
  if (!track.last) return;
  const Leg last = *track.last;
  const std::size_t axis = ir::indexOf(last.axis);
  const bool back = next && last.begin && isZero(state.facts, difference(next, last.begin));
  if (last.forced || (last.sign != 0 && back)) {
    if (back) {
      consumed = true;
      returns_[last.step].insert(step);
    }
    track.at[axis] = last.begin;
    track.before.reset();
    track.last.reset();
    return;
  }
  if (last.sign != 0) withoutReturn_.insert(last.step);
  if (track.before && !track.before->exempt && last.sign == 0) {
    const Leg& before = *track.before;
    const auto first = difference(before.target, before.begin);
    const auto second = difference(last.target, last.begin);
    const bool goesOn = first && second &&
                        ((provenAbove(state.facts, *first) && provenAbove(state.facts, *second)) ||
                         (provenBelow(state.facts, *first) && provenBelow(state.facts, *second)));
    const bool rises = before.axis == ir::Axis::Z && first && provenAbove(state.facts, *first);
    if (!goesOn) turn(track, before, rises);
  }
  track.before.reset();
  if (next) track.before = last;
  if (last.sign == 0 && (!next || last.exempt)) stand(track);
  track.last.reset();
}

// Whether the code shows a touch here: the path to the contact is known to have one sign, and the move ends
// the radius of the ball before it.
void TouchNotes::note(WalkState& state, Leg& leg) {
  MoveNotes& notes = notes_[leg.step];
  if (notes.axis && notes.axis != leg.axis) notes.oneAxis = false;
  notes.axis = leg.axis;
  notes.begin.add(leg.begin);
  const auto way = difference(leg.target, leg.begin);
  notes.above = notes.above && way && provenAbove(state.facts, *way);
  notes.below = notes.below && way && provenBelow(state.facts, *way);
  if (!leg.forced && leg.axis != ir::Axis::Z && way && radius_ != kNoVariable) {
    const Symbol symbol = Symbol::variable(radius_);
    const Value radius = sourceValue(symbol);
    const auto holds = [&](const Value& value) { return factorOf(symbol, value) != 0; };
    for (const int sign : {1, -1}) {
      // The radius is in the target, and nowhere in the way from the begin to the contact.
      const auto contact = linear(leg.target, 1, radius, sign);
      const auto form = linear(*way, 1, radius, sign);
      if (!contact || !form || holds(*contact) || holds(*form)) continue;
      if (!(sign > 0 ? provenNotBelow(state.facts, *form) : provenNotAbove(state.facts, *form))) continue;
      if (provenZero(state.facts, *form)) continue;
      leg.sign = sign;
      ShownTouch& shown = notes.shown[sign];
      shown.forms.emplace(canonical(*form), *form);
      shown.contact.add(contact);
      if (!(sign > 0 ? provenAbove(state.facts, *form) : provenBelow(state.facts, *form)))
        shown.mayBeNone = true;
      keep(shown.facts, state.facts);
      notes.alwaysIdle = false;
      return;
    }
  }
  notes.moves = true;
  notes.alwaysIdle = false;
  keep(notes.others, state.facts);
}

// The vector from the move's end to a point that does not depend on the ball is as long as its radius, and
// along no axis.
bool TouchNotes::endsTheRadiusBefore(const std::array<std::optional<Value>, 3>& target) const {
  if (radius_ == kNoVariable) return false;
  constexpr double kSame = 1e-6;
  double square = 0;
  int axes = 0;
  for (const std::optional<Value>& one : target) {
    const double factor = one ? factorOf(Symbol::variable(radius_), *one) : 0;
    square += factor * factor;
    axes += std::abs(factor) > kSame ? 1 : 0;
  }
  return axes > 1 && std::abs(std::sqrt(square) - 1) < kSame;
}

void TouchNotes::move(WalkState& state, std::size_t step, const std::array<std::optional<Value>, 3>& target) {
  const auto& move = std::get<FlatMove>(flat_->steps[step].step);
  MoveNotes& notes = notes_[step];
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (target[axis]) notes.target[axis].add(target[axis]);
  const std::size_t written = writtenAxis(move);
  const std::vector<ir::Axis> changed = changedAxes(state, target);
  const bool idle = changed.empty();
  const std::size_t axis = axisOf(written, changed);
  if (const auto out = idle ? std::nullopt : std::exchange(state.track.out, std::nullopt)) {
    const bool back = std::all_of(std::begin(ir::kAxes), std::end(ir::kAxes), [&](ir::Axis each) {
      const std::size_t i = ir::indexOf(each);
      return isZero(state.facts, difference(target[i] ? target[i] : state.track.at[i], out->begin[i]));
    });
    if (back) oblique_.insert(out->step);
  }
  bool consumed = false;
  const std::optional<std::size_t> previous =
      state.track.last ? std::optional(state.track.last->step) : std::nullopt;
  if (const auto& last = state.track.last) {
    const std::size_t lastAxis = ir::indexOf(last->axis);
    const bool along = idle ? last->forced : axis == lastAxis;
    // A move without a way, along the same axis or to the same point, is no follower of a plain move. After
    // a touch, which comes back by itself, it is none without a way.
    if (last->forced || last->sign != 0 || !idle || (written != kNowhere && written != lastAxis))
      judge(state, along ? target[lastAxis] : std::nullopt, step, consumed);
  }
  // After a touch that came back there may be nowhere left to go.
  const bool now = changedAxes(state, target).empty();
  if (now || consumed) {
    notes.returns = notes.returns || consumed;
    keep(notes.others, state.facts);
    if (axis != kNowhere) notes.begin.add(state.track.at[axis]);
    for (std::size_t i = 0; i < 3; ++i)
      if (target[i]) state.track.at[i] = target[i];
    return;
  }
  if (axis == kNowhere) {
    if (endsTheRadiusBefore(target)) oblique_.insert(step);
    state.track.out = Out{step, state.track.at};
    notes.oneAxis = false;
    notes.moves = true;
    notes.alwaysIdle = false;
    keep(notes.others, state.facts);
    for (std::size_t i = 0; i < 3; ++i)
      if (target[i]) state.track.at[i] = target[i];
    stand(state.track);
    return;
  }
  Leg leg;
  leg.step = step;
  leg.axis = ir::kAxes[axis];
  leg.begin = state.track.at[axis];
  leg.target = *target[axis];
  leg.forced = forced_.contains(step);
  leg.exempt = written == kNowhere && !leg.begin;
  if (!state.track.before) state.track.run = step;
  note(state, leg);
  if (previous && (leg.forced || leg.sign != 0)) approaches_.insert(*previous);
  if (!leg.forced) state.track.at[axis] = leg.target;
  state.track.last = std::move(leg);
}

void TouchNotes::end(WalkState& state) {
  bool consumed = false;
  judge(state, std::nullopt, kNowhere, consumed);
  for (const Turn& each : state.track.turns)
    candidates_[each.run].insert(each.step);
}

void ReversalTrace::move(WalkState& state, std::size_t step,
                         const std::array<std::optional<Value>, 3>& target) {
  Track& track = state.track;
  const std::size_t written = writtenAxis(std::get<FlatMove>(flat_.steps[step].step));
  const std::vector<ir::Axis> changed = changedAxes(state, target);
  const std::size_t axis = axisOf(written, changed);
  const auto sideOf = [](const Leg& leg) {
    const auto way = difference(leg.target, leg.begin);
    const double* known = way ? std::get_if<double>(&*way) : nullptr;
    return known == nullptr || *known == 0 ? 0 : *known > 0 ? 1 : -1;
  };
  std::optional<Leg> leg;
  if (axis != kNowhere && !changed.empty()) {
    leg = Leg{};
    leg->step = step;
    leg->axis = ir::kAxes[axis];
    leg->begin = track.at[axis];
    leg->target = *target[axis];
    if (track.last && ir::indexOf(track.last->axis) == axis && sideOf(*leg) * sideOf(*track.last) < 0) {
      const bool rises = leg->axis == ir::Axis::Z && sideOf(*leg) < 0;
      (rises ? rises_ : reversals_).insert(track.last->step);
    }
  }
  const bool skipped =
      changed.empty() && (written == kNowhere || (track.last && ir::indexOf(track.last->axis) == written));
  if (!skipped) track.last = leg;
  if (forced_.contains(step)) {
    track.last.reset();
    return;
  }
  if (out_ && std::all_of(std::begin(ir::kAxes), std::end(ir::kAxes), [&](ir::Axis each) {
        const std::size_t i = ir::indexOf(each);
        const auto& there = target[i] ? target[i] : track.at[i];
        const auto way = difference(there, outBegin_[i]);
        const double* known = way ? std::get_if<double>(&*way) : nullptr;
        return known != nullptr && *known == 0;
      }))
    oblique_.insert(*out_);
  if (!changed.empty()) out_.reset();
  if (changed.size() > 1) {
    out_ = step;
    outBegin_ = track.at;
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (target[i]) track.at[i] = target[i];
}

} // namespace dotek::frontend::gibbs
