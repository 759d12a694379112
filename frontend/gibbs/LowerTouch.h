// Which moves of a path are touches: what each path through the path macro knows where a move begins, and
// whether the path comes back after it.
#pragma once

#include "frontend/gibbs/LowerWalk.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace dotek::frontend::gibbs {

// One value wherever a path arrives, or several.
struct Seen {
  std::optional<Value> value; // nothing: not seen, or not known
  bool varies = false;
  void add(const std::optional<Value>& next);

private:
  bool any_ = false;
};

// The paths on which a move is a touch towards one side.
struct ShownTouch {
  std::map<std::string, Value> forms; // way to the contact, by text: above 0 to one side, below to the other
  Seen contact;                       // from the entry
  std::vector<Facts> facts;           // what each path knows before the move
  bool mayBeNone = false;             // on some path the contact may lie where the move begins
};

// A move over all paths that reach it.
struct MoveNotes {
  std::map<int, ShownTouch> shown; // by side: 1 and -1
  std::vector<Facts> others;       // ways on which it is no touch
  bool moves = false;              // on one of these it goes somewhere
  bool returns = false;            // follows a touch and goes back to where that began
  bool alwaysIdle = true;          // nowhere to go, touches counted as come back
  bool oneAxis = true;
  std::optional<ir::Axis> axis;    // of a move along one
  Seen begin;                      // along the axis of a move along one axis
  std::array<Seen, 3> target;      // as written
  bool above = true, below = true; // on all paths the target lies above (below) the begin
};

class TouchNotes : public MoveObserver {
public:
  // `forced`: steps that are touches because the user says so. `radius`: of the ball; kNoVariable: no such.
  // `places`: keep where a path has stood; a touch goes elsewhere.
  TouchNotes(const Flat& flat, std::set<std::size_t> forced, ir::VariableId radius, bool places)
      : flat_(&flat), forced_(std::move(forced)), radius_(radius), places_(places) {}

  void move(WalkState& state, std::size_t step, const std::array<std::optional<Value>, 3>& target) override;
  void end(WalkState& state) override;

  const MoveNotes& of(std::size_t step) const;
  bool isForced(std::size_t step) const { return forced_.contains(step); }
  // Moves that could be touches and are not shown, by the first move of their run along one axis. None of
  // them leads to a touch on any way, nor lacks its path back.
  std::map<std::size_t, std::set<std::size_t>> candidates() const;
  // Moves that go to a contact as a touch does, but do not come back.
  const std::set<std::size_t>& withoutReturn() const { return withoutReturn_; }
  // Moves that end the radius before a contact at or beyond their begin, where no move does so for the other
  // side: nothing says that a contact at the begin is none.
  std::set<std::size_t> oneSided() const;
  // Moves along several axes at once that end the radius before a point, or after which the path goes
  // straight back.
  const std::set<std::size_t>& oblique() const { return oblique_; }
  // Moves that go back from the touch.
  std::set<std::size_t> returnsOf(std::size_t touch) const;

private:
  void judge(WalkState& state, const std::optional<Value>& next, std::size_t step, bool& consumed);
  void note(WalkState& state, Leg& leg);
  bool endsTheRadiusBefore(const std::array<std::optional<Value>, 3>& target) const;
  std::size_t placeOf(const Track& track, std::size_t axis, const Value& target);
  void stand(Track& track);
  void turn(Track& track, const Leg& leg, bool rises);

  const Flat* flat_;
  std::set<std::size_t> forced_;
  ir::VariableId radius_;
  bool places_;
  std::map<std::string, std::size_t> placeNumbers_;
  std::map<std::size_t, MoveNotes> notes_;
  std::map<std::size_t, std::set<std::size_t>> candidates_;
  std::map<std::size_t, std::set<std::size_t>> returns_;
  std::set<std::size_t> withoutReturn_;
  std::set<std::size_t> approaches_; // moves after which a touch follows
  std::set<std::size_t> oblique_;
};

// Follows one path with known values: the moves after which the path goes back along the same axis.
class ReversalTrace : public MoveObserver {
public:
  ReversalTrace(const Flat& flat, std::set<std::size_t> forced) : flat_(flat), forced_(std::move(forced)) {}
  void move(WalkState& state, std::size_t step, const std::array<std::optional<Value>, 3>& target) override;
  void end(WalkState&) override {}
  const std::set<std::size_t>& reversals() const { return reversals_; }
  // Moves along Z that lead up before the path goes down again.
  const std::set<std::size_t>& rises() const { return rises_; }
  // Moves along several axes at once after which the path goes straight back.
  const std::set<std::size_t>& oblique() const { return oblique_; }

private:
  const Flat& flat_;
  std::set<std::size_t> forced_;
  std::set<std::size_t> reversals_;
  std::set<std::size_t> rises_;
  std::set<std::size_t> oblique_;
  std::optional<std::size_t> out_; // the last move, where it is along several axes at once
  std::array<std::optional<Value>, 3> outBegin_;
};

} // namespace dotek::frontend::gibbs
